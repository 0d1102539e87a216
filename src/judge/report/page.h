#pragma once
#include <string>

#include "judge/report/report.h"

namespace limpid {

/// The report as one page of HTML that is XML as well and refers to nothing outside it.
std::string to_html(const Report& report);

}  // namespace limpid

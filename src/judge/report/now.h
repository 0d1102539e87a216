#pragma once
#include <string>

namespace limpid {

/// UTC, ISO 8601, to the second.
std::string now_text();

}  // namespace limpid

#pragma once
#include <string>

#include "judge/report/report.h"

/// The sections of the page. Each returns markup, and "" when there is nothing to show.

namespace limpid {

/// The most important numbers, as a list of sentences.
std::string summary(const Report& report);
std::string facts_section(const Report& report);
std::string subjects_section(const Report& report);
std::string runners_section(const Report& report);
std::string looks_section(const Report& report);
std::string truth_section(const Report& report);
std::string traced_section(const Report& report);
std::string brought_section(const Report& report);
std::string choices_section(const Report& report);
std::string budgets_section(const Report& report);
std::string method_section(const Report& report);

}  // namespace limpid

#pragma once
#include "arguments.h"

/// `report` of one plate.

namespace limpid::tool {

/// Whether a plate is named, be it by a scene.
bool is_of_shot(const ReportArguments& arguments);

/// Throws the usage Error for an option that only the report of a shot has.
void expect_no_shot_options(const ReportArguments& arguments);

/// Measures the shot into a page. Throws Error for options that only the other reports have.
int shot_report(const ReportArguments& arguments, const CommonArguments& common);

}  // namespace limpid::tool

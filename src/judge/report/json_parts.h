#pragma once
#include <string>

#include <nlohmann/json.hpp>

#include "judge/report/report.h"

/// JSON shared by all reports.

namespace limpid {

using Json = nlohmann::ordered_json;

Json json_of(const PixelError& error);
Json json_of(const ReportMachine& machine);
Json json_of(const ReportBuild& build);

/// The scale of heat maps: from 10^-decades to 1, logarithmic, over 255 colors.
Json heat_scale();

/// The text of a file; invalid UTF-8, as in names of files, is replaced.
std::string text_of(const Json& json);

}  // namespace limpid

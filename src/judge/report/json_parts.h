#pragma once
#include <string>

#include <nlohmann/json.hpp>

#include "judge/report/report.h"

/// What the JSON of all reports has in common.

namespace limpid {

using Json = nlohmann::ordered_json;

Json json_of(const PixelError& error);
Json json_of(const ReportMachine& machine);
Json json_of(const ReportBuild& build);

/// What the colors of heat maps mean: from 10^-decades to 1, evenly spaced, of 255.
Json heat_scale();

/// As a file has it; text that is no UTF-8, as names of files may be, is mended.
std::string text_of(const Json& json);

}  // namespace limpid

#pragma once
#include <string>
#include <string_view>

#include "judge/report/report.h"

/// The pages of the folder page: HTML, style and script, with data for the script put in.

namespace limpid {

/// The report as one page that refers to nothing outside it and is XML as well; it shows to_json()
/// and the pictures.
std::string to_html(const Report& report);

/// The hard cases, from hard.json, as such a page.
std::string to_hard_html(std::string_view json);

/// A shot, from its report.json (judge/shot/shot_json.h), as such a page, beside which its pictures
/// lie.
std::string to_shot_html(std::string_view json);

}  // namespace limpid

#pragma once
#include <string>
#include <string_view>

#include "judge/report/report.h"

/// The pages of the folder page: HTML, style and script, with the script's data inserted.

namespace limpid {

/// The report as a self-contained page that is XML as well; it shows to_json() and the pictures.
std::string to_html(const Report& report);

/// The hard cases, from hard.json, as such a page.
std::string to_hard_html(std::string_view json);

/// A shot, from its report.json (judge/shot/shot_json.h), as such a page; its pictures are files
/// beside the page.
std::string to_shot_html(std::string_view json);

}  // namespace limpid

#pragma once
#include <filesystem>
#include <span>

#include "judge/hard/hard.h"

namespace limpid {

/// Creates the folder if it does not exist, as make_report_folder() does, for these two files.
void make_hard_folder(const std::filesystem::path& folder);
/// Writes hard.json and hard.html, a self-contained page. Each appears complete or not at all.
void write_hard(const std::filesystem::path& folder, std::span<const HardRow> rows);

}  // namespace limpid

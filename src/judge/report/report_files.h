#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace limpid {

/// Creates a folder for files of these names, and checks that they can be written. Throws Error.
void make_folder_for(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Writes the text, or leaves the former file. Throws Error.
void write_whole(const std::filesystem::path& path, const std::string& text);

}  // namespace limpid

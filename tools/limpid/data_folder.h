#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "limpid/ops/look.h"

namespace limpid::tool {

/// The folder with looks, scenes, plates and maps: $LIMPID_DATA or ../share/limpid relative to the
/// tool's own folder, the first that has them all. Throws Error if neither has.
std::filesystem::path data_folder();

/// Folders of looks, best first: of the same two.
std::vector<std::filesystem::path> look_folders();

/// The folder for caches: $XDG_CACHE_HOME/limpid, else $HOME/.cache/limpid, else "".
std::filesystem::path cache_folder();

/// A look by name or file.
Look look_for(std::string_view name_or_file);

}  // namespace limpid::tool

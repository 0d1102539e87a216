#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "limpid/ops/look.h"

namespace limpid::tool {

/// The folder with looks, scenes, plates and maps: $LIMPID_DATA, share/limpid beside the tool, or
/// the source tree's, the first that has them all. Throws Error where none has.
std::filesystem::path data_folder();

/// Folders that hold looks, best first: $LIMPID_DATA/looks, share/limpid/looks beside the tool, the
/// source tree's.
std::vector<std::filesystem::path> look_folders();

/// A look by name or file.
Look look_for(std::string_view name_or_file);

}  // namespace limpid::tool

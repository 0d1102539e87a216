#pragma once
#include <string>
#include <vector>

#include "desk/desk.h"

namespace limpid::tool {

/// The looks that come with the tool, then its presets, each by name, and the one that is named.
std::vector<DeskLook> known_looks(const std::string& named);

}  // namespace limpid::tool

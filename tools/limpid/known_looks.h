#pragma once
#include <string>
#include <vector>

#include "desk/desk.h"

namespace limpid::tool {

/// The looks of the tool, then its presets, each by name, and the named look.
std::vector<DeskLook> known_looks(const std::string& named);

}  // namespace limpid::tool

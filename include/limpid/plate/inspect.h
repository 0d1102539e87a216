#pragma once
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/plate/layers.h"

namespace limpid {

/// An opened file and what its headers say; its place in the list is ChannelRef::file.
struct InspectedFile {
  std::string name;
  std::span<const ExrPart> parts;
  std::map<std::string, std::string> made = {};  ///< what it says of how limpid made it, by name
  std::string color_space = {};                  ///< that its first part tells of, or ""
};

/// The views of all files, and the one whose channels are used; "" is the one without a name.
struct InspectedViews {
  std::vector<std::string> names = {};
  std::string used = {};
};

/// What `limpid inspect` prints: each file with its color space, if it tells of one, each of its
/// parts with its windows, storage and layers (a line for each layer and sample type), the views if
/// there are any, then where each role comes from and why. `problems` has the sentence of the Error
/// for roles that could not be decided. Last what files say of how they were made. Control
/// characters in names and texts of the files appear as '?'.
std::string inspect_text(std::span<const InspectedFile> files, const LayerChoices& choices,
                         const std::map<std::string_view, std::string>& problems = {},
                         const InspectedViews& views = {});

}  // namespace limpid

#pragma once
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/plate/layers.h"

namespace limpid {

/// An opened file and the contents of its headers; its index in the list is ChannelRef::file.
struct InspectedFile {
  std::string name;
  std::span<const ExrPart> parts;
  std::map<std::string, std::string> made = {};  ///< limpid's records on how it was made, by name
  std::string color_space = {};                  ///< of its first part, or ""
};

/// The views of all files, and the view whose channels are used; "" is a view without a name.
struct InspectedViews {
  std::vector<std::string> names = {};
  std::string used = {};
};

/// The output of `limpid inspect`: each file with its color space, if its header has one, each of
/// its parts with its windows, storage and layers (a line for each layer and sample type), the
/// views if there are any, and the source of each role, with the reason. `problems` has the
/// sentence of the Error for roles without an unambiguous source. At the end are limpid's records
/// on how the files were made. Control characters in names and texts of the files appear as '?'.
std::string inspect_text(std::span<const InspectedFile> files, const LayerChoices& choices,
                         const std::map<std::string_view, std::string>& problems = {},
                         const InspectedViews& views = {});

}  // namespace limpid

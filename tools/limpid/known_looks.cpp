#include "known_looks.h"

#include <algorithm>

#include "limpid/files/text/look_file.h"

#include "data_folder.h"

namespace limpid::tool {

std::vector<DeskLook> known_looks(const std::string& named) {
  std::vector<DeskLook> looks;
  bool is_there = false;
  for (const std::string& name : look_names(look_folders())) {
    looks.push_back({name, look_for(name)});
    is_there |= name == named;
  }
  if (!is_there) looks.push_back({named, look_for(named)});
  std::stable_partition(looks.begin(), looks.end(),
                        [](const DeskLook& look) { return !look.is_preset(); });
  return looks;
}

}  // namespace limpid::tool

#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/field.h"

namespace limpid {

/// A key of a table of a scene file.
struct SceneKey : FieldInfo {
  std::string
      unset;  ///< what holds where the file lacks it: a value, "required", or "" for nothing
};

struct SceneTable {
  std::string_view name, about;
  std::vector<SceneKey> keys;
};

/// All that a scene file may say, in the order of docs/files.md: load_scene() and to_toml()
/// go by the same declaration.
std::vector<SceneTable> scene_tables();

}  // namespace limpid

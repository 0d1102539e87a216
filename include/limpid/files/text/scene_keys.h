#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/field.h"

namespace limpid {

/// A key of a table of a scene file.
struct SceneKey : FieldInfo {
  std::string unset;  ///< default if the file lacks the key: a value, "required", or "" for none
};

struct SceneTable {
  std::string_view name, about;
  std::vector<SceneKey> keys;
};

/// All tables and keys of a scene file, in the order of docs/files.md. load_scene() and to_toml()
/// use the same declaration.
std::vector<SceneTable> scene_tables();

}  // namespace limpid

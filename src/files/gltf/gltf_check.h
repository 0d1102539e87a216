#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/files/gltf/gltf.h"

#include "files/gltf/model_warnings.h"
#include "files/text/json_place.h"

/// Checks a glTF document before it is read: every index, size, type and uri. Errors that only the
/// buffers' bytes can show (index values, NaN) are checked by their readers, and so are materials.

namespace limpid {

/// Why objects of a document cannot be read, "" for valid ones; one entry per object of each list.
struct GltfFaults {
  std::vector<std::string> meshes, skins, nodes;
};

/// `binary_bytes` is the size of a .glb's binary chunk. Throws Error as load_gltf() says; with
/// Undrawable::kLeaveOut faults of a single mesh, skin or node are returned instead.
GltfFaults check_gltf(const JsonPlace& root, std::optional<std::int64_t> binary_bytes,
                      const Limits& limits, Undrawable undrawable, ModelWarnings& warnings);

// Its parts, a source file each.
void check_gltf_buffers(const JsonPlace& root, std::optional<std::int64_t> binary_bytes,
                        const Limits& limits);
void check_gltf_meshes(const JsonPlace& root, Undrawable undrawable, GltfFaults& faults);
void check_gltf_skins(const JsonPlace& root, Undrawable undrawable, GltfFaults& faults);
void check_gltf_nodes(const JsonPlace& root, Undrawable undrawable, GltfFaults& faults);

/// The faults that `check` finds in each object: thrown, or with kLeaveOut returned.
template <class Check>
std::vector<std::string> faults_of(const std::vector<JsonPlace>& things, Undrawable undrawable,
                                   Check check) {
  std::vector<std::string> faults(things.size());
  for (std::size_t i = 0; i < things.size(); ++i) {
    try {
      check(things[i]);
    } catch (const Error& error) {
      if (undrawable == Undrawable::kRefuse) throw;
      faults[i] = error.what();
    }
  }
  return faults;
}

}  // namespace limpid

#include "judge/report/finer_water.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace limpid {
namespace {

/// A vertex in the middle of each edge, which its two triangles share.
class Parting {
 public:
  explicit Parting(Mesh& mesh) : mesh_(mesh) {}

  void run() {
    std::vector<std::uint32_t> indices;
    for (std::size_t t = 0; t + 2 < mesh_.indices.size(); t += 3) {
      const std::uint32_t a = mesh_.indices[t], b = mesh_.indices[t + 1], c = mesh_.indices[t + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      indices.insert(indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    mesh_.indices = std::move(indices);
  }

 private:
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
    const auto [at, is_new] = middles_.try_emplace(std::minmax(a, b), next);
    if (is_new) mesh_.positions.push_back(0.5f * (mesh_.positions[a] + mesh_.positions[b]));
    return at->second;
  }

  Mesh& mesh_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

}  // namespace

Model with_finer_water(Model model, int times) {
  std::set<int> meshes;
  for (const Instance& instance : model.instances) {
    if (instance.water) meshes.insert(instance.mesh);
  }
  for (const int index : meshes) {
    Mesh& mesh = model.meshes[static_cast<std::size_t>(index)];
    mesh.normals.clear();
    mesh.uvs.clear();
    mesh.second_uvs.clear();
    mesh.colors.clear();
    for (int i = 0; i < times; ++i) Parting(mesh).run();
  }
  return model;
}

}  // namespace limpid

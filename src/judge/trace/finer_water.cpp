#include "judge/trace/finer_water.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace limpid {
namespace {

constexpr double kFarEdge = 1.0 / 4, kNearEdge = 1.0 / 16;  ///< of the shortest wave
constexpr double kFirstReach = 16;                          ///< that is tried, in waves
constexpr double kSeenEdge = 0.01;                          ///< of its distance

double longest_edge(const FinerWater& how, double distance) {
  return std::clamp(kSeenEdge * distance, kNearEdge * how.shortest_wave,
                    kFarEdge * how.shortest_wave);
}

/// Parts the edges of a mesh within a reach, until none is too long.
class Parting {
 public:
  Parting(Mesh mesh, const glm::dmat4& world, const FinerWater& how, double reach)
      : mesh_(std::move(mesh)), world_(world), how_(how), reach_(reach) {}

  /// False where there would be more triangles than that.
  bool run(std::size_t most) {
    while (mesh_.indices.size() / 3 <= most) {
      if (!mark()) return true;
      if (mesh_.indices.size() / 3 + more_ > most) return false;
      part();
    }
    return false;
  }
  Mesh take() { return std::move(mesh_); }

 private:
  using Index = std::uint32_t;

  static std::uint64_t key(Index a, Index b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }

  /// Beyond the reach an edge is as long as it is far away, so that none leads past what is near.
  bool is_long(Index a, Index b) const {
    const glm::dvec3 from(world_ * glm::dvec4(mesh_.positions[a], 1));
    const glm::dvec3 to(world_ * glm::dvec4(mesh_.positions[b], 1));
    const glm::dvec3 edge = to - from;
    const double t = glm::dot(how_.eye - from, edge) / std::max(glm::dot(edge, edge), 1e-300);
    const double distance = glm::distance(how_.eye, from + std::clamp(t, 0.0, 1.0) * edge);
    const double most = longest_edge(how_, distance);
    return glm::length(edge) > (distance < reach_ ? most : std::max(most, distance));
  }

  /// Puts a vertex in the middle of each long edge. Whether there is one.
  bool mark() {
    middles_.clear();
    more_ = 0;
    for (std::size_t t = 0; t + 2 < mesh_.indices.size(); t += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index a = mesh_.indices[t + k], b = mesh_.indices[t + (k + 1) % 3];
        if (!is_long(a, b)) continue;
        ++more_;
        const auto [at, is_new] =
            middles_.try_emplace(key(a, b), static_cast<Index>(mesh_.positions.size()));
        if (is_new) mesh_.positions.push_back(0.5f * (mesh_.positions[a] + mesh_.positions[b]));
      }
    }
    return more_ > 0;
  }

  const Index* middle(Index a, Index b) const {
    const auto at = middles_.find(key(a, b));
    return at == middles_.end() ? nullptr : &at->second;
  }

  /// A triangle falls into one more for each of its edges that has a middle.
  void part() {
    std::vector<Index> indices;
    indices.reserve(mesh_.indices.size() + 3 * more_);
    const auto add = [&](Index a, Index b, Index c) { indices.insert(indices.end(), {a, b, c}); };
    for (std::size_t t = 0; t + 2 < mesh_.indices.size(); t += 3) {
      const Index* corner = &mesh_.indices[t];
      const Index* middles[3];
      int parted = 0, first = 0;
      for (int k = 0; k < 3; ++k) {
        middles[k] = middle(corner[k], corner[(k + 1) % 3]);
        if (middles[k]) ++parted;
      }
      // Turned so that the edge from a is the only one that is parted, or c a the only one not.
      for (int k = 0; k < 3; ++k) {
        if (parted == 1 ? middles[k] != nullptr : parted == 2 && !middles[(k + 2) % 3]) first = k;
      }
      const Index a = corner[first], b = corner[(first + 1) % 3], c = corner[(first + 2) % 3];
      const Index *ab = middles[first], *bc = middles[(first + 1) % 3];
      const Index* ca = middles[(first + 2) % 3];
      switch (parted) {
        case 0:
          add(a, b, c);
          break;
        case 1:
          add(a, *ab, c);
          add(*ab, b, c);
          break;
        case 2:
          add(*ab, b, *bc);
          add(a, *ab, *bc);
          add(a, *bc, c);
          break;
        default:
          add(a, *ab, *ca);
          add(*ab, b, *bc);
          add(*ca, *bc, c);
          add(*ab, *bc, *ca);
      }
    }
    mesh_.indices = std::move(indices);
  }

  Mesh mesh_;
  glm::dmat4 world_;
  const FinerWater& how_;
  double reach_;
  std::size_t more_ = 0;
  std::unordered_map<std::uint64_t, Index> middles_;
};

/// The water's meshes parted within a reach, one for each instance, for what is near in one may be
/// far in another. None where that would be more triangles than `most`.
std::vector<Mesh> parted_within(double reach, const Model& model, const FinerWater& how) {
  std::vector<Mesh> meshes;
  std::size_t left = how.most;
  for (const Instance& water : model.instances) {
    if (!water.water) continue;
    Mesh mesh = model.meshes[static_cast<std::size_t>(water.mesh)];
    mesh.normals.clear();
    mesh.uvs.clear();
    mesh.second_uvs.clear();
    mesh.colors.clear();
    Parting parting(std::move(mesh), water.world_from_mesh, how, reach);
    if (!parting.run(left)) return {};
    meshes.push_back(parting.take());
    left -= std::min(left, meshes.back().indices.size() / 3);
  }
  return meshes;
}

}  // namespace

double shortest_wave(std::span<const SineWave> waves) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const SineWave& wave : waves) {
    shortest = std::min(shortest, 2 * std::numbers::pi / std::hypot(wave.k_x, wave.k_y));
  }
  return shortest;
}

PartedWater with_finer_water(Model model, const FinerWater& how) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  PartedWater made;
  made.reach = kAll;
  std::vector<Mesh> meshes = parted_within(kAll, model, how);
  const bool has_water = std::any_of(model.instances.begin(), model.instances.end(),
                                     [](const Instance& instance) { return instance.water; });
  if (has_water && meshes.empty()) {
    // The greatest reach that is not too far, to a factor of sqrt(2).
    double reach = kFirstReach * how.shortest_wave, step = 2;
    made.reach = 0;
    while (step > 1.2 && reach > kNearEdge * how.shortest_wave) {
      std::vector<Mesh> parted = parted_within(reach, model, how);
      if (!parted.empty()) {
        meshes = std::move(parted);
        made.reach = reach;
        if (step < 2) break;
        // Twice this reach has been too far if it was halved.
        if (reach < kFirstReach * how.shortest_wave) step = std::sqrt(step);
        reach *= step;
      } else if (meshes.empty()) {
        reach /= 2;
      } else {
        step = std::sqrt(step);
        reach = made.reach * step;
      }
    }
  }
  std::size_t next = 0;
  for (Instance& water : model.instances) {
    if (!water.water) continue;
    if (next < meshes.size()) {
      water.mesh = static_cast<int>(model.meshes.size());
      model.meshes.push_back(std::move(meshes[next++]));
    }
    made.triangles += model.meshes[static_cast<std::size_t>(water.mesh)].indices.size() / 3;
  }
  made.model = std::move(model);
  return made;
}

}  // namespace limpid

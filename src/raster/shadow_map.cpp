#include "raster/shadow_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"
#include "limpid/raster/rasterise.h"
#include "limpid/raster/render_plate.h"

namespace limpid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Extent {
  glm::dvec3 min{kInfinity}, max{-kInfinity};
  void add(const glm::dvec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  bool empty() const { return !(min.x <= max.x); }
};

/// Rows: right, up, towards the sun.
glm::dmat3 sun_rotation(const glm::dvec3& sun) {
  const glm::dvec3 other = std::abs(sun.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(other, sun));
  return glm::transpose(glm::dmat3(right, glm::cross(sun, right), sun));
}

Extent casters_extent(const Model& model, const glm::dmat3& sun_from_world) {
  Extent extent;
  for (const Instance& instance : model.instances) {
    if (instance.water) continue;
    const glm::dmat3 linear = sun_from_world * glm::dmat3(instance.world_from_mesh);
    const glm::dvec3 shift = sun_from_world * glm::dvec3(instance.world_from_mesh[3]);
    for (const glm::vec3& p : model.meshes[static_cast<std::size_t>(instance.mesh)].positions) {
      extent.add(linear * glm::dvec3(p) + shift);
    }
  }
  return extent;
}

/// Only across the sun's direction: objects nearer to the sun cast shadows into the box, too.
void keep_within(const Box& bounds, const glm::dmat3& sun_from_world, Extent& extent) {
  Extent box;
  for (int corner = 0; corner < 8; ++corner) {
    box.add(sun_from_world * glm::dvec3(corner & 1 ? bounds.max.x : bounds.min.x,
                                        corner & 2 ? bounds.max.y : bounds.min.y,
                                        corner & 4 ? bounds.max.z : bounds.min.z));
  }
  for (int c = 0; c < 2; ++c) {
    const double low = std::max(extent.min[c], box.min[c]);
    const double high = std::min(extent.max[c], box.max[c]);
    if (!(low <= high)) continue;  // no part of it casts; any part of the map will do
    extent.min[c] = low;
    extent.max[c] = high;
  }
}

}  // namespace

ShadowMap make_shadow_map(const Model& model, const Sun& sun, const std::optional<Box>& bounds,
                          int size, Executor& executor, const std::string& simd) {
  if (size < 1 || size > kMaxShadowMap) {
    throw Error("shadow map of " + std::to_string(size) + " texels: expected 1 ... " +
                    std::to_string(kMaxShadowMap),
                Fault::kUsage);
  }
  Scene scene;
  scene.sun = sun;
  scene.validate();
  ShadowMap map;
  map.sun_from_world = sun_rotation(sun.direction);
  Extent extent = casters_extent(model, map.sun_from_world);
  if (extent.empty()) extent.min = extent.max = glm::dvec3(0);
  if (bounds) keep_within(*bounds, map.sun_from_world, extent);

  // Square texels; two of them beyond the casters on each side, so that the edge is lit.
  const glm::dvec3 centre = 0.5 * (extent.min + extent.max), reach = extent.max - extent.min;
  const double room = std::max({reach.x, reach.y, 1e-9 * glm::length(centre), 1e-9});
  const double width = room * size / std::max(size - 4, 1);
  const double depth = std::max(reach.z, room);
  const double margin = 0.01 * depth;
  map.texel = width / size;
  map.bias = 0.05 * map.texel + 1e-6 * (depth + glm::length(centre));

  RasterView view;
  view.display = view.window = {0, 0, size, size};
  view.cull = false;
  const glm::dvec3 eye(centre.x, centre.y, extent.max.z + margin);
  view.camera.view = glm::dmat4(map.sun_from_world);
  view.camera.view[3] = glm::dvec4(-eye, 1);
  view.camera.projection =
      orthographic(width, width, 0, reach.z + 2 * margin, ClipSpace::kReversed);
  view.camera.clip = ClipSpace::kReversed;
  RasterImage image = rasterise(model, view, {sun, nullptr}, {.depth = true}, executor, simd);
  map.depth = std::move(image.depth);

  // Texel y runs down.
  glm::dmat4 map_from_sun(0.0);
  map_from_sun[0][0] = 1 / map.texel;
  map_from_sun[1][1] = -1 / map.texel;
  map_from_sun[2][2] = -1;
  map_from_sun[3] = {0.5 * size, 0.5 * size, 0, 1};
  map.map_from_world = map_from_sun * view.camera.view;
  return map;
}

double shadow_at(const ShadowMap& map, glm::dvec3 world, glm::dvec3 normal) {
  const glm::dvec3 turned = map.sun_from_world * normal;
  if (!(turned.z > 0)) return 0;
  const glm::dvec3 at(map.map_from_world * glm::dvec4(world, 1));
  const double slope =
      std::min((std::abs(turned.x) + std::abs(turned.y)) / turned.z, ShadowMap::kMaxSlope);
  const double depth = at.z - ShadowMap::kBiasTexels * map.texel * slope - map.bias;
  const double x = std::clamp(at.x - 0.5, -1e6, 1e6), y = std::clamp(at.y - 0.5, -1e6, 1e6);
  const double s = x - std::floor(x), t = y - std::floor(y);
  const double across[4] = {1 - s, 1, 1, s}, down[4] = {1 - t, 1, 1, t};
  const View<const float> stored = map.depth.view();
  double lit = 0;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const int column = static_cast<int>(std::floor(x)) - 1 + i;
      const int row = static_cast<int>(std::floor(y)) - 1 + j;
      const bool outside = column < stored.window.x0 || column >= stored.window.x1 ||
                           row < stored.window.y0 || row >= stored.window.y1;
      if (outside || depth <= stored.at(column, row)) lit += across[i] * down[j];
    }
  }
  return lit / 9;
}

}  // namespace limpid

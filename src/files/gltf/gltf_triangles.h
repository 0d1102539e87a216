#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "files/text/json_place.h"

/// How the corners of a primitive form triangles (glTF 2.0, 3.7.2.1 "Overview" of meshes).

namespace limpid {

enum class GltfMode : std::uint8_t {
  kPoints,
  kLines,
  kLineLoop,
  kLineStrip,
  kTriangles,
  kStrip,
  kFan,
};

/// The mode of a primitive. Throws Error for an unknown mode.
inline GltfMode gltf_mode_of(const JsonPlace& primitive) {
  const std::optional<JsonPlace> mode = primitive.find("mode");
  return mode ? static_cast<GltfMode>(mode->integer(0, 6)) : GltfMode::kTriangles;
}

constexpr bool is_triangles(GltfMode mode) { return mode >= GltfMode::kTriangles; }

/// Number of triangles with this many corners.
constexpr std::size_t triangle_count(GltfMode mode, std::size_t corners) {
  if (corners < 3) return 0;
  return mode == GltfMode::kTriangles ? corners / 3 : corners - 2;
}

/// The corners of a triangle, counter-clockwise seen from its front.
constexpr std::array<std::size_t, 3> corners_of_triangle(GltfMode mode, std::size_t triangle) {
  const std::size_t i = triangle;
  if (mode == GltfMode::kStrip) return {i, i + 1 + i % 2, i + 2 - i % 2};
  if (mode == GltfMode::kFan) return {i + 1, i + 2, 0};
  return {3 * i, 3 * i + 1, 3 * i + 2};
}

}  // namespace limpid

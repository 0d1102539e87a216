#pragma once
#include <string>

#include <glm/vec2.hpp>

#include "files/text/json_place.h"

namespace limpid {

/// What KHR_texture_transform does to uvs: scales, turns, then moves them.
struct UvTransform {
  glm::dvec2 u{1, 0}, v{0, 1};  ///< the factors of u and v in each result
  glm::dvec2 offset{0, 0};

  glm::dvec2 apply(glm::dvec2 uv) const;
  friend bool operator==(const UvTransform&, const UvTransform&) = default;
};

/// Which uvs of a mesh a texture is looked up by.
struct UvSource {
  int set = 0;  ///< n of TEXCOORD_n
  UvTransform transform;

  std::string attribute() const { return "TEXCOORD_" + std::to_string(set); }
  std::string text() const;  ///< the same, and whether it is transformed
  friend bool operator==(const UvSource&, const UvSource&) = default;
};

/// Reads them of a textureInfo.
UvSource read_uv_source(const JsonPlace& texture_info);

}  // namespace limpid

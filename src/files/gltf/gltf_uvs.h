#pragma once
#include <string>

#include <glm/vec2.hpp>

#include "files/text/json_place.h"

namespace limpid {

/// The transform of KHR_texture_transform on uvs: scales, rotates, then translates.
struct UvTransform {
  glm::dvec2 u{1, 0}, v{0, 1};  ///< the factors of u and v in each result
  glm::dvec2 offset{0, 0};

  glm::dvec2 apply(glm::dvec2 uv) const;
  friend bool operator==(const UvTransform&, const UvTransform&) = default;
};

/// The uvs of a mesh for a texture lookup.
struct UvSource {
  int set = 0;  ///< n of TEXCOORD_n
  UvTransform transform;

  std::string attribute() const { return "TEXCOORD_" + std::to_string(set); }
  std::string text() const;  ///< text with the set and the transform
  friend bool operator==(const UvSource&, const UvSource&) = default;
};

/// Reads the uv source of a textureInfo.
UvSource read_uv_source(const JsonPlace& texture_info);

}  // namespace limpid

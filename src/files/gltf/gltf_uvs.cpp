#include "files/gltf/gltf_uvs.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "files/gltf/gltf_extensions.h"

namespace limpid {
namespace {

// Counter-clockwise in the picture, whose v runs down.
UvTransform read_transform(const JsonPlace& extension) {
  glm::dvec2 scale(1), offset(0);
  double angle = 0;
  const auto pair = [&](const char* key, glm::dvec2& value) {
    const auto found = extension.find(key);
    if (!found) return;
    const std::vector<double> numbers = found->numbers(2);
    value = {numbers[0], numbers[1]};
  };
  pair("scale", scale);
  pair("offset", offset);
  if (const auto rotation = extension.find("rotation")) angle = rotation->number();
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c * scale.x, s * scale.y}, {-s * scale.x, c * scale.y}, offset};
}

}  // namespace

glm::dvec2 UvTransform::apply(glm::dvec2 uv) const {
  return glm::dvec2(glm::dot(u, uv), glm::dot(v, uv)) + offset;
}

std::string UvSource::text() const {
  return attribute() + (transform == UvTransform{} ? "" : " transformed");
}

UvSource read_uv_source(const JsonPlace& texture_info) {
  UvSource source;
  const auto read_set = [&](const JsonPlace& place) {
    if (const auto set = place.find("texCoord")) {
      source.set = static_cast<int>(set->integer(0, INT32_MAX));
    }
  };
  read_set(texture_info);
  if (const auto extension = extension_of(texture_info, "KHR_texture_transform")) {
    source.transform = read_transform(*extension);
    read_set(*extension);
  }
  return source;
}

}  // namespace limpid

#include "files/gltf/gltf_camera.h"

#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

double number_or(const JsonPlace& object, std::string_view key, double otherwise) {
  const auto number = object.find(key);
  return number ? number->number() : otherwise;
}

glm::dmat4 projection_of(const JsonPlace& camera) {
  if (camera.at("type").text() == "orthographic") {
    const JsonPlace lens = camera.at("orthographic");
    return orthographic(2 * lens.at("xmag").number(), 2 * lens.at("ymag").number(),
                        lens.at("znear").number(), lens.at("zfar").number(), ClipSpace::kGl);
  }
  const JsonPlace lens = camera.at("perspective");
  return perspective(
      lens.at("yfov").number(), number_or(lens, "aspectRatio", 1), lens.at("znear").number(),
      number_or(lens, "zfar", std::numeric_limits<double>::infinity()), ClipSpace::kGl);
}

}  // namespace

Camera gltf_camera(const JsonPlace& place, glm::dmat4 world) {
  for (int c = 0; c < 3; ++c) world[c] = glm::normalize(world[c]);
  if (glm::determinant(glm::dmat3(world)) < 0) {
    throw Error("its camera is mirrored, expected a rotation and a translation");
  }
  const Camera camera{glm::inverse(world), projection_of(place), ClipSpace::kGl};
  camera.validate();
  return camera;
}

}  // namespace limpid

#include "limpid/core/camera.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr ClipSpace kClips[] = {ClipSpace::kGl, ClipSpace::kD3d, ClipSpace::kReversed};

Camera tilted_camera() {
  Camera camera;
  camera.view = glm::lookAt(glm::dvec3(3, 2, 5), glm::dvec3(0, -1, 0.5), glm::dvec3(0, 1, 0));
  return camera;
}

glm::dvec3 projected(const Camera& camera, glm::dvec3 world) {
  const glm::dvec4 clip = camera.projection * camera.view * glm::dvec4(world, 1);
  return glm::dvec3(clip) / clip.w;
}

TEST(Camera, NearAndFarLandOnTheEndsOfTheClipRange) {
  for (ClipSpace clip : kClips) {
    const double at_near = clip == ClipSpace::kGl ? -1 : clip == ClipSpace::kD3d ? 0 : 1;
    for (double far : {50.0, kInfinity}) {
      Camera camera;
      camera.clip = clip;
      camera.projection = perspective(1.0, 1.5, 0.25, far, clip);
      EXPECT_NEAR(camera.device_from_eye_depth(0.25), at_near, 1e-12);
      EXPECT_NEAR(camera.device_from_eye_depth(std::isinf(far) ? 1e15 : far),
                  camera.far_device_depth(), 1e-12);
    }
    Camera camera;
    camera.clip = clip;
    camera.projection = orthographic(4, 3, -2, 10, clip);
    EXPECT_TRUE(camera.orthographic());
    EXPECT_NEAR(camera.device_from_eye_depth(-2), at_near, 1e-12);
    EXPECT_NEAR(camera.device_from_eye_depth(10), camera.far_device_depth(), 1e-12);
  }
}

TEST(Camera, RaysInvertTheProjection) {
  const glm::ivec2 size(64, 48);
  for (bool flat : {false, true}) {
    Camera camera = tilted_camera();
    camera.projection =
        flat ? orthographic(8, 6, 0.1, 100, ClipSpace::kD3d)
             : perspective(0.9, 4.0 / 3, 0.1, kInfinity, ClipSpace::kReversed, {0.3, -0.2});
    const Rays rays = rays_of(camera, size);
    for (double depth : {0.5, 7.0}) {
      const double x = 12.5, y = 40.5;
      const glm::dvec3 world = camera.eye() + rays.origin_at(x, y) + depth * rays.ray_at(x, y);
      const glm::dvec3 ndc = projected(camera, world);
      EXPECT_NEAR((ndc.x + 1) / 2 * size.x, x, 1e-10);
      EXPECT_NEAR((1 - ndc.y) / 2 * size.y, y, 1e-10);
      EXPECT_NEAR(-(camera.view * glm::dvec4(world, 1)).z, depth, 1e-10);
    }
  }
}

TEST(Camera, BasisIsRightHandedAndUnit) {
  const Camera camera = tilted_camera();
  EXPECT_NEAR(glm::length(camera.right()), 1, 1e-12);
  EXPECT_NEAR(glm::dot(camera.right(), camera.up()), 0, 1e-12);
  EXPECT_NEAR(glm::length(camera.eye() - glm::dvec3(3, 2, 5)), 0, 1e-12);
}

TEST(Camera, RefusesWhatItCannotInvert) {
  Camera camera;
  camera.projection = perspective(1, 1, 1, 10, ClipSpace::kGl);
  EXPECT_NO_THROW(camera.validate());
  Camera singular = camera;
  singular.view[0] = {0, 0, 0, 0};
  EXPECT_THROW(singular.validate(), Error);
  Camera scaled = camera;
  scaled.view[0] *= 2;
  EXPECT_THROW(scaled.validate(), Error);
  Camera nan = camera;
  nan.projection[2][2] = std::nan("");
  EXPECT_THROW(nan.validate(), Error);
  Camera flat = camera;
  flat.projection[0][0] = 0;
  EXPECT_THROW(flat.validate(), Error);
  EXPECT_THROW(perspective(0, 1, 1, 10, ClipSpace::kGl), Error);
  EXPECT_THROW(perspective(1, 1, 10, 10, ClipSpace::kGl), Error);
  EXPECT_THROW(orthographic(1, 1, 0, kInfinity, ClipSpace::kGl), Error);
}

}  // namespace
}  // namespace limpid

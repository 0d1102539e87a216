#include "limpid/optics/depth.h"

#include <cmath>
#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limpid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr ClipSpace kClips[] = {ClipSpace::kGl, ClipSpace::kD3d, ClipSpace::kReversed};

TEST(Depth, DeviceInvertsEveryProjection) {
  for (ClipSpace clip : kClips) {
    for (double far : {60.0, kInfinity}) {
      Camera camera;
      camera.clip = clip;
      camera.projection = perspective(0.8, 1.5, 0.5, far, clip, {0.2, -0.1});
      for (double depth : {0.5, 0.7, 3.0, 20.0, 59.0}) {
        const double device = camera.device_from_eye_depth(depth);
        EXPECT_NEAR(eye_depth_from_device(device, device_depth_of(camera)), depth, 1e-10 * depth);
      }
    }
    Camera flat;
    flat.clip = clip;
    flat.projection = orthographic(4, 3, -1, 20, clip);
    for (double depth : {-1.0, 0.0, 3.0, 20.0}) {
      const double device = flat.device_from_eye_depth(depth);
      EXPECT_NEAR(eye_depth_from_device(device, device_depth_of(flat)), depth, 1e-12);
    }
  }
}

// GL, near 1, far 3: z_ndc = (f + n)/(f - n) - 2 f n / ((f - n) Z) = 2 - 3 / Z.
TEST(Depth, DeviceHandWorked) {
  Camera camera;
  camera.projection = perspective(1, 1, 1, 3, ClipSpace::kGl);
  EXPECT_NEAR(eye_depth_from_device(0.5, device_depth_of(camera)), 2, 1e-14);
  // D3D, far infinite, near 1: z_ndc = 1 - 1 / Z. Reversed: 1 / Z.
  camera.projection = perspective(1, 1, 1, kInfinity, ClipSpace::kD3d);
  EXPECT_NEAR(eye_depth_from_device(0.75, device_depth_of(camera)), 4, 1e-14);
  camera.projection = perspective(1, 1, 1, kInfinity, ClipSpace::kReversed);
  EXPECT_NEAR(eye_depth_from_device(0.25, device_depth_of(camera)), 4, 1e-14);
}

TEST(Depth, FarPlaneOfAnInfiniteProjectionIsInfinite) {
  for (ClipSpace clip : kClips) {
    Camera camera;
    camera.clip = clip;
    camera.projection = perspective(0.8, 1.5, 0.5, kInfinity, clip);
    const double depth = eye_depth_from_device(camera.far_device_depth(), device_depth_of(camera));
    EXPECT_TRUE(std::isinf(depth));
  }
}

TEST(Depth, RayDistanceIsTheLengthAlongThePixelsRay) {
  Camera camera;
  camera.view = glm::lookAt(glm::dvec3(1, 2, 3), glm::dvec3(0, 0, 0), glm::dvec3(0, 1, 0));
  camera.projection = perspective(1.2, 1.5, 0.1, 100, ClipSpace::kGl, {0.1, 0.3});
  const Rays rays = rays_of(camera, {60, 40});
  for (double depth : {0.3, 8.0}) {
    const double x = 3.5, y = 35.5;
    const glm::dvec3 from_eye = rays.origin_at(x, y) + depth * rays.ray_at(x, y);
    EXPECT_NEAR(eye_depth_from_ray_distance(glm::length(from_eye), glm::length(rays.ray_at(x, y))),
                depth, 1e-12);
  }
  EXPECT_EQ(eye_depth_from_ray_distance(kInfinity, 1.5), kInfinity);
  // tan 45 degrees off the axis: sqrt(2) along the ray are 1 in depth.
  EXPECT_NEAR(eye_depth_from_ray_distance(std::sqrt(2.0), std::sqrt(2.0)), 1, 1e-15);
}

TEST(Depth, OrthographicRaysHaveLengthOne) {
  Camera camera;
  camera.projection = orthographic(4, 3, 0, 10, ClipSpace::kGl);
  EXPECT_NEAR(glm::length(rays_of(camera, {8, 6}).ray_at(7.5, 0.5)), 1, 1e-15);
}

TEST(Depth, InverseAndNormalised) {
  EXPECT_DOUBLE_EQ(eye_depth_from_inverse(0.25), 4);
  EXPECT_EQ(eye_depth_from_inverse(0.0), kInfinity);
  EXPECT_DOUBLE_EQ(eye_depth_from_normalised(0.0, 2.0, 10.0), 2);
  EXPECT_DOUBLE_EQ(eye_depth_from_normalised(0.25, 2.0, 10.0), 4);
  EXPECT_DOUBLE_EQ(eye_depth_from_normalised(1.0, 2.0, 10.0), 10);
}

}  // namespace
}  // namespace limpid

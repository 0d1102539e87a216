#include "raster/mirror.h"

#include <cmath>
#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr ClipSpace kClips[] = {ClipSpace::kGl, ClipSpace::kD3d, ClipSpace::kReversed};

const WaterPlane kTilted{glm::normalize(glm::dvec3(0.1, 1, -0.2)), 0.7};

Camera looking_down(double far, ClipSpace clip) {
  Camera camera;
  camera.view = glm::lookAt(glm::dvec3(1, 4, 6), glm::dvec3(0, 0.5, 0), glm::dvec3(0, 1, 0));
  camera.projection = perspective(0.9, 1.4, 0.2, far, clip);
  camera.clip = clip;
  return camera;
}

/// A point of the plane: its foot plus two tangents.
glm::dvec3 on_plane(const WaterPlane& plane, double a, double b) {
  const PlaneAxes axes = plane_axes(plane.up);
  return plane.height * plane.up + a * axes.x + b * axes.y;
}

double device_depth(const Camera& camera, glm::dvec3 world) {
  const glm::dvec4 clip = camera.projection * camera.view * glm::dvec4(world, 1);
  return clip.z / clip.w;
}

TEST(Mirror, TwiceIsTheIdentityAndPointsOfThePlaneStay) {
  const glm::dmat4 m = mirror(kTilted);
  const glm::dmat4 twice = m * m;
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(twice[c][r], c == r, 1e-14);
  }
  const glm::dvec3 p = on_plane(kTilted, 2, -3);
  EXPECT_NEAR(glm::length(glm::dvec3(m * glm::dvec4(p, 1)) - p), 0, 1e-14);
  EXPECT_NEAR(glm::determinant(glm::dmat3(m)), -1, 1e-14);
  // A point above the plane, by hand: straight over the plane y = 1, height 3 goes to -1.
  const glm::dvec4 q = mirror({{0, 1, 0}, 1}) * glm::dvec4(5, 3, 7, 1);
  EXPECT_EQ(glm::dvec3(q), glm::dvec3(5, -1, 7));
}

TEST(Mirror, ObliquePlanePointsLandOnTheNearPlane) {
  for (ClipSpace clip : kClips) {
    for (double far : {60.0, kInfinity}) {
      const Camera mirrored = mirrored_camera(looking_down(far, clip), kTilted);
      const double at_near = clip == ClipSpace::kGl ? -1 : clip == ClipSpace::kD3d ? 0 : 1;
      const double inwards = clip == ClipSpace::kReversed ? -1 : 1;
      for (double a : {-2.0, 0.0, 1.5}) {
        for (double b : {-1.0, 0.5}) {
          const glm::dvec3 p = on_plane(kTilted, a, b);
          EXPECT_NEAR(device_depth(mirrored, p), at_near, 1e-12);
          // A point above the plane is beyond the near plane and inside the range; a point below is
          // cut away.
          EXPECT_GT(inwards * (device_depth(mirrored, p + 0.1 * kTilted.up) - at_near), 0);
          EXPECT_LT(inwards * (device_depth(mirrored, p - 0.1 * kTilted.up) - at_near), 0);
        }
      }
    }
  }
}

TEST(Mirror, NothingOfTheOldFrustumIsLostAtTheFarPlane) {
  for (ClipSpace clip : kClips) {
    const Camera camera = looking_down(60, clip);
    const Camera mirrored = mirrored_camera(camera, kTilted);
    // Walk the old frustum of the mirrored view: points above the plane must stay within the clip
    // range.
    Camera plain = mirrored;
    plain.projection = camera.projection;
    const glm::dmat4 world_from_clip = glm::inverse(plain.projection * plain.view);
    const double low = clip == ClipSpace::kGl ? -1 : 0;
    int checked = 0;
    for (double x = -1; x <= 1; x += 0.25) {
      for (double y = -1; y <= 1; y += 0.25) {
        for (double z = low; z <= 1; z += 0.125) {
          const glm::dvec4 h = world_from_clip * glm::dvec4(x, y, z, 1);
          const glm::dvec3 p = glm::dvec3(h) / h.w;
          if (glm::dot(kTilted.up, p) - kTilted.height < 1e-6) continue;
          const double d = device_depth(mirrored, p);
          EXPECT_GE(d, low - 1e-9);
          EXPECT_LE(d, 1 + 1e-9);
          ++checked;
        }
      }
    }
    EXPECT_GT(checked, 50);
  }
}

TEST(Mirror, SeesTheMirrorImageWhereTheCameraDoes) {
  const Camera camera = looking_down(60, ClipSpace::kGl);
  const Camera mirrored = mirrored_camera(camera, kTilted);
  const glm::dvec3 p(0.3, 2, -1);
  const glm::dvec4 image = camera.projection * camera.view * mirror(kTilted) * glm::dvec4(p, 1);
  const glm::dvec4 seen = mirrored.projection * mirrored.view * glm::dvec4(p, 1);
  EXPECT_NEAR(image.x / image.w, seen.x / seen.w, 1e-12);
  EXPECT_NEAR(image.y / image.w, seen.y / seen.w, 1e-12);
}

TEST(Mirror, RefusesAPlaneThroughTheEye) {
  Camera camera = looking_down(60, ClipSpace::kGl);
  EXPECT_THROW(mirrored_camera(camera, {{0, 1, 0}, 4}), Error);
}

}  // namespace
}  // namespace limpid

#include "complete/surface_shadow.h"

#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "complete/sun_sight.h"
#include "support.h"

// The sun's shadows on the water, from those of the dry picture.

namespace limpid {
namespace {

constexpr Size kSize{160, 120};
constexpr double kEye = 2, kDeep = 1;

/// Water over a level bottom, seen from above at an angle, with a sun beside the viewer.
struct Pond {
  Scene scene = test::simple_scene(kSize);
  test::Buffers buffers{rect_of(kSize)};
  glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.6, 1, 0.3));

  Pond() {
    const glm::dvec3 eye(0, kEye, 0);
    scene.camera->view = glm::lookAt(eye, eye + glm::dvec3(0, -0.8, -1), {0, 1, 0});
    scene.sun = Sun{.direction = to_sun};
    show([&](int x, int y) { return depth_of(x, y, -kDeep); });
  }
  template <class Depth>
  void show(Depth&& depth) {
    buffers.set(PlaneId::kDepth, [&](int x, int y) { return static_cast<float>(depth(x, y)); });
  }
  /// lit(x, z) on the bottom.
  template <class Lit>
  void shade(Lit&& lit) {
    buffers.set(PlaneId::kShadow, [&](int x, int y) {
      const glm::dvec3 at = point(x, y, -kDeep);
      return static_cast<float>(lit(at.x, at.z));
    });
  }
  glm::dvec3 ray(int x, int y) const {
    return rays_of(*scene.camera, {kSize.width, kSize.height}).ray_at(x + 0.5, y + 0.5);
  }
  double depth_of(int x, int y, double height) const {
    const double down = -ray(x, y).y;
    return down > 0 ? (kEye - height) / down : HUGE_VAL;
  }
  glm::dvec3 point(int x, int y, double height) const {
    return glm::dvec3(0, kEye, 0) + depth_of(x, y, height) * ray(x, y);
  }
  /// Where the sun's ray through the water of a pixel ends on the bottom.
  glm::dvec3 end(int x, int y) const { return point(x, y, 0) - (kDeep / to_sun.y) * to_sun; }
  bool shows(const glm::dvec3& at) const {
    const glm::dvec3 seen = scene.camera->view * glm::dvec4(at, 1);
    const glm::dvec3 corner = scene.camera->view * glm::dvec4(point(0, 0, -kDeep), 1);
    const glm::dvec2 place = glm::abs(glm::dvec2(seen) / seen.z),
                     most = glm::abs(glm::dvec2(corner) / corner.z);
    return place.x < 0.95 * most.x && place.y < 0.95 * most.y;
  }
  View<const float> made(SurfaceShadow& shadow, int threads = 1) const {
    const Pass pass(scene, buffers.frame, 1.333, {});
    shadow.make(buffers.frame, pass, *make_executor(threads));
    return shadow.plane().view();
  }
};

TEST(SurfaceShadow, IsThatOfTheBottomWhereTheSunsRaysEnd) {
  Pond pond;
  const auto lit = [](double x, double z) { return 0.5 + 0.5 * std::sin(2 * x) * std::cos(2 * z); };
  pond.shade(lit);
  SurfaceShadow shadow;
  const View<const float> got = pond.made(shadow);
  int known = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const glm::dvec3 end = pond.end(x, y);
      if (!pond.shows(end)) continue;
      EXPECT_NEAR(got.at(x, y), lit(end.x, end.z), 0.02) << x << ", " << y;
      ++known;
    }
  }
  EXPECT_GT(known, kSize.width * kSize.height / 3);
}

TEST(SurfaceShadow, KeepsTheEdgesOfShadows) {
  Pond pond;
  const auto lit = [](double x, double) { return x > -0.3 ? 1.0 : 0.0; };
  pond.shade(lit);
  SurfaceShadow shadow;
  const View<const float> got = pond.made(shadow);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const glm::dvec3 end = pond.end(x, y);
      const double pixel = pond.point(x + 1, y, -kDeep).x - pond.point(x, y, -kDeep).x;
      if (!pond.shows(end) || std::abs(end.x + 0.3) < pixel) continue;
      EXPECT_EQ(got.at(x, y), lit(end.x, end.z)) << x << ", " << y;
    }
  }
}

/// A rock that ends under the water shades the bottom, not the water.
TEST(SurfaceShadow, HasNoneOfObjectsUnderTheWater) {
  Pond pond;
  const auto on_rock = [](const glm::dvec3& at) {
    return std::abs(at.x) < 0.5 && std::abs(at.z + 2) < 0.5;
  };
  pond.show([&](int x, int y) {
    const double height = on_rock(pond.point(x, y, -0.4)) ? -0.4 : -kDeep;
    return pond.depth_of(x, y, height);
  });
  pond.buffers.set(PlaneId::kShadow, [&](int x, int y) {
    const glm::dvec3 at = pond.point(x, y, -kDeep) + (0.6 / pond.to_sun.y) * pond.to_sun;
    return on_rock(pond.point(x, y, -0.4)) || !on_rock(at) ? 1.0f : 0.0f;
  });
  SurfaceShadow shadow;
  const View<const float> got = pond.made(shadow);
  int dark = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const glm::dvec3 water = pond.point(x, y, 0);
      // Over the middle of the rock, the sun's ray ends there.
      const glm::dvec3 there = water - (0.4 / pond.to_sun.y) * pond.to_sun;
      if (std::abs(there.x) < 0.35 && std::abs(there.z + 2) < 0.35) {
        dark += got.at(x, y) < 0.5f ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(dark, 0);
}

/// No bottom is seen: what stands between the water and the sun is searched.
TEST(SurfaceShadow, IsSearchedWhereNoEndIsSeen) {
  Pond pond;
  pond.to_sun = glm::normalize(glm::dvec3(0, 1, -1));
  pond.scene.sun->direction = pond.to_sun;
  // A wall across the picture, whose top is seen.
  constexpr double kWall = -4, kHigh = 0.7;
  pond.show([&](int x, int y) {
    const glm::dvec3 ray = pond.ray(x, y);
    const double wall = ray.z < 0 ? kWall / ray.z : HUGE_VAL;
    return kEye + wall * ray.y < kHigh ? wall : HUGE_VAL;
  });
  pond.buffers.fill(PlaneId::kShadow, 1);
  SurfaceShadow shadow;
  const View<const float> got = pond.made(shadow);
  int lit = 0, shaded = 0;
  for (int y = 0; y < kSize.height; ++y) {
    const glm::dvec3 water = pond.point(kSize.width / 2, y, 0);
    const double away = water.z - kWall;
    if (away < 0.1 || std::abs(away - kHigh) < 0.1) continue;
    EXPECT_EQ(got.at(kSize.width / 2, y), away > kHigh ? 1 : 0) << away;
    (away > kHigh ? lit : shaded) += 1;
  }
  EXPECT_GT(lit, 10);
  EXPECT_GT(shaded, 5);
}

/// Also in the margin of the depth, and after a frame of another size.
TEST(SurfaceShadow, IsInTheWindowOfTheDepth) {
  Pond pond;
  pond.shade([](double, double) { return 1.0; });
  SurfaceShadow shadow;
  pond.made(shadow);
  const Rect wide{-8, -4, kSize.width + 6, kSize.height + 2};
  test::Buffers margin(wide);
  margin.set(PlaneId::kDepth,
             [&](int x, int y) { return static_cast<float>(pond.depth_of(x, y, -kDeep)); });
  margin.set(PlaneId::kShadow,
             [&](int x, int y) { return pond.point(x, y, -kDeep).x > -0.3 ? 1.0f : 0.0f; });
  margin.frame.display = rect_of(kSize);
  const Pass pass(pond.scene, margin.frame, 1.333, {});
  shadow.make(margin.frame, pass, *make_executor(1));
  const View<const float> got = shadow.plane().view();
  ASSERT_EQ(got.window, wide);
  int known = 0;
  for (int y = wide.y0; y < wide.y1; ++y) {
    for (int x = wide.x0; x < wide.x1; ++x) {
      const glm::dvec3 end = pond.end(x, y);
      if (!pond.shows(end) || std::abs(end.x + 0.3) < 0.1) continue;
      EXPECT_EQ(got.at(x, y), end.x > -0.3 ? 1 : 0) << x << ", " << y;
      ++known;
    }
  }
  EXPECT_GT(known, kSize.width * kSize.height / 3);
}

TEST(SurfaceShadow, LiesOnTheSurfaceOfThePlate) {
  Pond pond;
  constexpr double kRaised = 0.4;
  pond.buffers.set(PlaneId::kSurfaceDepth,
                   [&](int x, int y) { return static_cast<float>(pond.depth_of(x, y, kRaised)); });
  const auto lit = [](double x, double z) { return 0.5 + 0.5 * std::sin(2 * x) * std::cos(2 * z); };
  pond.shade(lit);
  SurfaceShadow shadow;
  const View<const float> got = pond.made(shadow);
  int known = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const glm::dvec3 end =
          pond.point(x, y, kRaised) - ((kDeep + kRaised) / pond.to_sun.y) * pond.to_sun;
      if (!pond.shows(end)) continue;
      EXPECT_NEAR(got.at(x, y), lit(end.x, end.z), 0.02) << x << ", " << y;
      ++known;
    }
  }
  EXPECT_GT(known, kSize.width * kSize.height / 3);
}

/// The bottom behind a wall, as its albedo needs it.
TEST(SunSight, TellsTheShadeOfSurfaces) {
  Pond pond;
  pond.to_sun = glm::normalize(glm::dvec3(0, 1, -1));
  pond.scene.sun->direction = pond.to_sun;
  constexpr double kWall = -4, kHigh = 0.7;
  pond.show([&](int x, int y) {
    const glm::dvec3 ray = pond.ray(x, y);
    const double wall = ray.z < 0 ? kWall / ray.z : HUGE_VAL;
    const double dry = std::min(wall, pond.depth_of(x, y, -kDeep));
    return kEye + wall * ray.y < kHigh ? dry : HUGE_VAL;
  });
  const Pass pass(pond.scene, pond.buffers.frame, 1.333, {});
  const SunSight sight(pond.buffers.frame.plane(PlaneId::kDepth), pass);
  int lit = 0, shaded = 0;
  for (int y = 0; y < kSize.height; ++y) {
    const glm::dvec3 bottom = pond.point(kSize.width / 2, y, -kDeep);
    const double away = bottom.z - kWall, shade = kHigh + kDeep;
    if (away < 0.2 || std::abs(away - shade) < 0.15) continue;
    EXPECT_EQ(sight.hidden_from_surface(kSize.width / 2, y), away < shade ? 1 : 0) << away;
    (away > shade ? lit : shaded) += 1;
  }
  EXPECT_GT(lit, 10);
  EXPECT_GT(shaded, 10);
}

TEST(SurfaceShadow, IsNoneWithoutASunOverTheHorizon) {
  Pond pond;
  pond.buffers.fill(PlaneId::kShadow, 0);
  pond.scene.sun->direction = glm::normalize(glm::dvec3(0, -0.1, 1));
  SurfaceShadow shadow;
  EXPECT_EQ(pond.made(shadow).at(80, 60), 1);
}

TEST(SurfaceShadow, IsTheSameForAnyNumberOfThreads) {
  Pond pond;
  pond.shade([](double x, double z) { return std::sin(9 * x * z) > 0 ? 1.0 : 0.0; });
  SurfaceShadow one, three;
  const View<const float> a = pond.made(one), b = pond.made(three, 3);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) ASSERT_EQ(a.at(x, y), b.at(x, y)) << x << ", " << y;
  }
}

}  // namespace
}  // namespace limpid

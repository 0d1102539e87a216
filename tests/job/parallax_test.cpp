#include "job/parallax.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "limpid/core/executor.h"
#include "limpid/core/scene.h"

/// Motion vectors by the camera of a second frame.

namespace limpid {
namespace {

constexpr Rect kDisplay{0, 0, 41, 31};
constexpr double kIor = 1.333;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Pixels, of the distance of the eye from the picture, with 60 degrees from its top to its bottom.
const double kFocus = 15.5 / std::tan(glm::radians(30.0));

Plane constant(double value) {
  Plane plane(kDisplay);
  for (int y = 0; y < kDisplay.y1; ++y) {
    for (int x = 0; x < kDisplay.x1; ++x) plane.view().at(x, y) = static_cast<float>(value);
  }
  return plane;
}

Scene scene_at(const glm::dvec3& eye, const glm::dvec3& direction, const glm::dvec3& up) {
  Scene scene;
  scene.camera =
      Camera{glm::lookAt(eye, eye + direction, up),
             perspective(glm::radians(60.0), 41.0 / 31, 0.1, 100, ClipSpace::kGl), ClipSpace::kGl};
  scene.water = WaterPlane{{0, 1, 0}, 0};
  return scene;
}

// 45 degrees in the air are asin(sin 45 / 1.333) in the water.
TEST(Parallax, RaysAreRefracted) {
  const double below = std::tan(std::asin(std::sin(glm::radians(45.0)) / kIor));
  EXPECT_NEAR(refracted_reach(1, 2, 1 + 2 * below, kIor), 1, 1e-12);
  EXPECT_NEAR(refracted_reach(3, 2, 5, 1), 3, 1e-12) << "a straight line";
  EXPECT_EQ(refracted_reach(3, 2, 0, kIor), 0);
  EXPECT_NEAR(refracted_reach(3, 0, 7, kIor), 7, 1e-12) << "a point in the surface";
  EXPECT_NEAR(refracted_reach(1, 1e-9, 1e3, kIor), 1e3, 1e-6);
}

/// A surface at one eye depth, whose normal leans by an angle towards an axis.
struct Leaning {
  Leaning(double depth, const glm::dvec3& axis, double angle)
      : planes{constant(depth), constant(std::sin(angle) * axis.x), constant(std::cos(angle)),
               constant(std::sin(angle) * axis.z)} {}
  WaterSurface surface() const {
    return {planes[0].view(), planes[1].view(), planes[2].view(), planes[3].view()};
  }
  std::array<Plane, 4> planes;
};

class PlumbTest : public ::testing::Test {
 protected:
  /// The vector in the middle of the picture of a camera that looks straight down, from 3 above the
  /// water to a bottom 2 below the water, and moves to the right and up the picture.
  glm::dvec2 moved(double right, double up, bool wet = true,
                   const std::optional<Parallax::Waves>& waves = {}) const {
    const glm::dvec3 eye(0, 3, 0), down(0, -1, 0), north(0, 0, -1);
    const WaterView now(scene_at(eye, down, north), kDisplay);
    const WaterView second(scene_at(eye + glm::dvec3(right, 0, -up), down, north), kDisplay);
    Plane u(kDisplay), v(kDisplay), x(kDisplay), y(kDisplay);
    for (int row = 0; row < kDisplay.y1; ++row) {
      for (int column = 0; column < kDisplay.x1; ++column) {
        u.view().at(column, row) = static_cast<float>((column + 0.5) / 41);
        v.view().at(column, row) = static_cast<float>(1 - (row + 0.5) / 31);
      }
    }
    const Plane surface = constant(wet ? 3 : kInfinity), depth = constant(5);
    Parallax(now, second, kIor, waves)
        .seen({u.view(), v.view(), surface.view(), kDisplay}, depth.view(), x.view(), y.view(),
              *make_executor(1));
    return {x.view().at(20, 15), y.view().at(20, 15)};
  }
};

// The second camera sees the point at an angle whose tangent is, in pixels, tan times kFocus.
TEST_F(PlumbTest, IsThatOfTheRefractedRay) {
  for (const double degrees : {5.0, 20.0, 30.0}) {
    const double air = glm::radians(degrees), water = std::asin(std::sin(air) / kIor);
    const double way = 3 * std::tan(air) + 2 * std::tan(water);
    const glm::dvec2 right = moved(way, 0), up = moved(0, way);
    EXPECT_NEAR(right.x, -kFocus * std::tan(air), 1e-3) << degrees;
    EXPECT_NEAR(right.y, 0, 1e-4);
    EXPECT_NEAR(up.y, -kFocus * std::tan(air), 1e-3) << degrees;
    EXPECT_NEAR(up.x, 0, 1e-4);
  }
}

// The point straight below the eye is at `air` from the vertical behind a surface that leans by
// theta: 3 tan(air) + 2 tan(water) = 0, and sin(air + theta) = ior sin(water + theta).
TEST_F(PlumbTest, LeadsToTheImageBehindWaterThatLeans) {
  const Leaning calm(3, {1, 0, 0}, 0);
  for (const double degrees : {0.5, 3.0}) {
    const double air = glm::radians(degrees), water = std::atan(-1.5 * std::tan(air));
    const double theta = std::atan((kIor * std::sin(water) - std::sin(air)) /
                                   (std::cos(air) - kIor * std::cos(water)));
    const Leaning right(3, {1, 0, 0}, theta), up(3, {0, 0, -1}, theta);
    const glm::dvec2 to_right = moved(0, 0, true, {{calm.surface(), right.surface()}});
    const glm::dvec2 to_up = moved(0, 0, true, {{calm.surface(), up.surface()}});
    EXPECT_NEAR(to_right.x, kFocus * std::tan(air), 2e-3) << degrees;
    EXPECT_NEAR(to_right.y, 0, 2e-3);
    EXPECT_NEAR(to_up.x, 0, 2e-3);
    EXPECT_NEAR(to_up.y, kFocus * std::tan(air), 2e-3) << degrees;
    EXPECT_EQ(moved(0, 0, true, {{right.surface(), right.surface()}}), glm::dvec2(0))
        << "the same water, whose own lookup is not what the picture has";
  }
}

// Water too steep to show the point anywhere near: the vector of calm water.
TEST_F(PlumbTest, IsThatOfCalmWaterWhereNoImageIsFound) {
  const Leaning calm(3, {1, 0, 0}, 0), steep(3, {1, 0, 0}, glm::radians(89.0));
  EXPECT_EQ(moved(0.3, 0, true, {{calm.surface(), steep.surface()}}), moved(0.3, 0));
}

TEST_F(PlumbTest, OfDryPixelsIsThatOfTheStraightRay) {
  EXPECT_NEAR(moved(0.5, 0, false).x, -kFocus * 0.5 / 5, 1e-4);
}

class MirroredTest : public ::testing::Test {
 protected:
  /// The vector of a pixel of the lower half of a level picture, whose mirrored ray ends at this
  /// image depth, if the camera moves to the right.
  glm::dvec2 moved(double right, double image,
                   const std::optional<Parallax::Waves>& waves = {}) const {
    const glm::dvec3 eye(0, 1.5, 0), north(0, 0, -1);
    const WaterView now(scene_at(eye, north, {0, 1, 0}), kDisplay);
    const WaterView second(scene_at(eye + glm::dvec3(right, 0, 0), north, {0, 1, 0}), kDisplay);
    const double depth = -1.5 / now.rays.ray_at(20.5, 25.5).y;
    const Plane surface = constant(depth), zero = constant(0), one = constant(1);
    const Plane ends = constant(image);
    Plane x(kDisplay), y(kDisplay);
    Parallax(now, second, kIor, waves)
        .reflected(
            {surface.view(), zero.view(), one.view(), zero.view(), ends.view(), ends.view(), now},
            x.view(), y.view(), *make_executor(1));
    return {x.view().at(20, 25), y.view().at(20, 25)};
  }
};

TEST_F(MirroredTest, IsThatOfTheImage) {
  const glm::dvec2 vector = moved(0.4, 8);
  EXPECT_NEAR(vector.x, -kFocus * 0.4 / 8, 1e-4);
  EXPECT_NEAR(vector.y, 0, 1e-4);
  const glm::dvec2 sky = moved(0.4, kInfinity);
  EXPECT_NEAR(sky.x, 0, 1e-6);
  EXPECT_NEAR(sky.y, 0, 1e-6);
}

// Where the water leans towards the camera by theta, the same part of the sky is mirrored at an
// angle of view that is 2 theta less steep.
TEST_F(MirroredTest, LeadsToTheSkyInWaterThatLeans) {
  const double steep = std::atan(10 / kFocus);  // of the pixel's ray
  const Leaning calm(3, {0, 0, 1}, 0);
  for (const double degrees : {-1.0, 2.0}) {
    const double theta = glm::radians(degrees);
    const Leaning leaning(3, {0, 0, 1}, theta);
    const glm::dvec2 vector = moved(0.4, kInfinity, {{calm.surface(), leaning.surface()}});
    EXPECT_NEAR(vector.x, 0, 2e-3);
    EXPECT_NEAR(vector.y, 10 - kFocus * std::tan(steep - 2 * theta), 2e-3) << degrees;
  }
}

}  // namespace
}  // namespace limpid

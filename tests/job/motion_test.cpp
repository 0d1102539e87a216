#include "job/motion.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "limpid/core/scene.h"

#include "job/plane_of.h"

/// Motion vectors of the bottom behind the water, and of objects that the water mirrors.

namespace limpid {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A map that looks up (ax x + bx y + cx, ...) at the pixel (x, y), y down.
class Lens {
 public:
  Lens(const std::function<std::array<double, 2>(double x, double y)>& place, float depth = 1)
      : u_(plane_of(kDisplay,
                    [&](int x, int y) { return place(x + 0.5, y + 0.5)[0] / kDisplay.width(); })),
        v_(plane_of(
            kDisplay,
            [&](int x, int y) { return 1 - place(x + 0.5, y + 0.5)[1] / kDisplay.height(); })),
        depth_(plane_of(kDisplay, [&](int, int) { return depth; })) {}

  LookedUp looked_up() const { return {u_.view(), v_.view(), depth_.view(), kDisplay}; }

  /// Vectors that grow to the right and down, carried through the lookup.
  std::array<Plane, 2> carried(const Rect& window = kDisplay) const {
    const Plane x = plane_of(kDisplay, [](int px, int) { return 2 + px; });
    const Plane y = plane_of(kDisplay, [](int, int py) { return -3 - py; });
    std::array<Plane, 2> seen{Plane(window), Plane(window)};
    carry_motion(looked_up(), x.view(), y.view(), seen[0].view(), seen[1].view());
    return seen;
  }

  static constexpr Rect kDisplay{0, 0, 40, 30};

 private:
  Plane u_, v_, depth_;
};

TEST(Motion, OfDryPixelsIsThePlates) {
  const Lens lens([](double x, double y) { return std::array{y, x}; }, kInfinity);
  const auto seen = lens.carried();
  EXPECT_EQ(seen[0].view().at(7, 9), 9);
  EXPECT_EQ(seen[1].view().at(7, 9), -12);
}

TEST(Motion, IsTurnedAndStretchedAsTheLookupIs) {
  // The place moves by (1.5, -0.25) and (0.5, 0.8) for a step to the right and down.
  const Lens lens([](double x, double y) {
    return std::array{1.5 * x + 0.5 * y - 15, -0.25 * x + 0.8 * y + 5};
  });
  const auto seen = lens.carried();
  const int x = 20, y = 12;
  const double from_x = std::floor(1.5 * 20.5 + 0.5 * 12.5 - 15);
  const double from_y = std::floor(-0.25 * 20.5 + 0.8 * 12.5 + 5);
  const double dx = seen[0].view().at(x, y), dy = -seen[1].view().at(x, y);
  EXPECT_NEAR(1.5 * dx + 0.5 * dy, 2 + from_x, 1e-3);
  EXPECT_NEAR(-0.25 * dx + 0.8 * dy, 3 + from_y, 1e-3);
  // At the rim there are no slopes: the result is the texel's own vector.
  EXPECT_EQ(seen[0].view().at(0, 12), 2 + std::floor(0.75 + 6.25 - 15 < 0 ? 0 : 0.75 + 6.25 - 15));
}

TEST(Motion, OfFoldsIsTheTexels) {
  const Lens mirrored([](double x, double y) { return std::array{39 - x, y}; });
  const auto seen = mirrored.carried();
  EXPECT_EQ(seen[0].view().at(10, 10), 2 + std::floor(39 - 10.5));
  EXPECT_EQ(seen[1].view().at(10, 10), -13);
}

TEST(Motion, IsFinite) {
  const Lens lens([](double x, double y) { return std::array{x, y}; });
  const Plane bad = plane_of(Lens::kDisplay, [](int x, int) {
    return x == 3 ? std::nan("") : x == 4 ? HUGE_VAL : 1;
  });
  std::array<Plane, 2> seen{Plane(Lens::kDisplay), Plane(Lens::kDisplay)};
  carry_motion(lens.looked_up(), bad.view(), bad.view(), seen[0].view(), seen[1].view());
  EXPECT_EQ(seen[0].view().at(3, 5), 0);
  EXPECT_EQ(seen[1].view().at(4, 5), 0);
  EXPECT_NEAR(seen[0].view().at(6, 5), 1, 1e-5);
}

/// The water mirrors a wall 8 in front of a level camera, which stands 1.5 above the water.
class WallTest : public ::testing::Test {
 protected:
  static constexpr Rect kDisplay{0, 0, 80, 60};
  static constexpr double kWall = 8, kEye = 1.5;

  WallTest() {
    scene_.camera = Camera{glm::lookAt(glm::dvec3(0, kEye, 0), glm::dvec3(0, kEye, -1), {0, 1, 0}),
                           perspective(glm::radians(60.0), 80.0 / 60, 0.1, 100, ClipSpace::kGl),
                           ClipSpace::kGl};
    scene_.water = WaterPlane{{0, 1, 0}, 0};
  }

  /// The vectors (2, 1 + row / 10), reflected by a normal that leans by the angle `lean` to the
  /// right; the picture has the depth `shown`, the mirror image the depth `image`.
  std::array<Plane, 2> reflected(double lean = 0, double shown = kWall,
                                 double image = kWall) const {
    const auto constant = [](double value) {
      return plane_of(kDisplay, [=](int, int) { return value; });
    };
    const WaterView view(scene_, kDisplay);
    const Plane surface = plane_of(kDisplay, [&](int x, int y) {
      const double z = -kEye / view.rays.ray_at(x + 0.5, y + 0.5).y;
      return z > 0 && z < kWall ? z : HUGE_VAL;
    });
    const Plane nx = constant(std::sin(lean)), ny = constant(std::cos(lean)), nz = constant(0);
    const Plane depth = constant(shown), mirror = constant(image), x = constant(2);
    const Plane y = plane_of(kDisplay, [](int, int row) { return 1 + row / 10.0; });
    std::array<Plane, 2> seen{Plane(kDisplay), Plane(kDisplay)};
    reflect_motion(
        {surface.view(), nx.view(), ny.view(), nz.view(), mirror.view(), depth.view(), view},
        x.view(), y.view(), seen[0].view(), seen[1].view());
    return seen;
  }

  Scene scene_;
};

// The horizon lies between the rows 29 and 30, the wall's foot 1.5 / 8 * 30 / tan 30 = 9.7 rows
// below the horizon. The image of a point at the height h is at -h: twice those rows further below
// the horizon than the point is above the horizon.
TEST_F(WallTest, IsTheThingsUpsideDown) {
  const auto seen = reflected();
  for (const int below : {11, 15, 25}) {
    const double rows_to_foot = 1.5 / 8 * 30 / std::tan(glm::radians(30.0));
    const double row = 30 - (below + 0.5 - 2 * rows_to_foot);
    const int thing = static_cast<int>(std::floor(row));
    for (const int column : {5, 40, 77}) {
      EXPECT_NEAR(seen[0].view().at(column, 30 + below), 2, 1e-4) << below;
      EXPECT_NEAR(seen[1].view().at(column, 30 + below), -(1 + thing / 10.0), 1e-4) << below;
    }
  }
  EXPECT_EQ(seen[0].view().at(40, 20), 0) << "dry";
  EXPECT_EQ(seen[0].view().at(40, 35), 0) << "the wall's foot";
}

// A mirrored point moves by the matrix 1 - 2 n n^T, which is its own inverse.
TEST_F(WallTest, IsTurnedAsTheNormalSays) {
  const double lean = glm::radians(-10.0);
  const auto seen = reflected(lean);
  const double c = std::cos(2 * lean), s = std::sin(2 * lean);
  int found = 0;
  for (int y = 42; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const double dx = seen[0].view().at(x, y), dy = seen[1].view().at(x, y);
      if (dx == 0 && dy == 0) continue;
      ++found;
      EXPECT_NEAR(c * dx - s * dy, 2, 1e-4) << x << " " << y;
      EXPECT_GE(-s * dx - c * dy, 1 - 1e-4) << x << " " << y;
    }
  }
  EXPECT_GT(found, 50);
}

TEST_F(WallTest, IsNoneOfWhatThePictureDoesNotShow) {
  const std::array<Plane, 2> hidden = reflected(0, 7), sky = reflected(0, kWall, HUGE_VAL);
  for (const auto& seen : {std::cref(hidden), std::cref(sky)}) {
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x) {
        EXPECT_EQ(seen.get()[0].view().at(x, y), 0);
        EXPECT_EQ(seen.get()[1].view().at(x, y), 0);
      }
    }
  }
  // A normal that leans by 40 degrees reflects points outside the picture, far to the right.
  EXPECT_EQ(reflected(glm::radians(40.0))[0].view().at(75, 50), 0);
}

}  // namespace
}  // namespace limpid

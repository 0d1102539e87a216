#include "enter/nothing_hit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limpid/enter/sanitise.h"

#include "support.h"

// The depth that a plate itself declares as "nothing hit", besides the numbers that always mean so.

namespace limpid {
namespace {

constexpr Rect kRow{0, 0, 4, 1};

/// The plane after entry.
std::array<float, 4> entered(std::array<float, 4> stored, const DepthSource& source) {
  Plane plane(kRow);
  for (int x = 0; x < 4; ++x) plane.view().at(x, 0) = stored[static_cast<std::size_t>(x)];
  make_eye_depth(plane.view(), source);
  std::array<float, 4> depths;
  for (int x = 0; x < 4; ++x) depths[static_cast<std::size_t>(x)] = plane.view().at(x, 0);
  return depths;
}

TEST(NothingHit, AZeroIsADepthUnlessItIsSaid) {
  EXPECT_EQ(entered({0, 1, 2, 3}, {}), (std::array<float, 4>{0, 1, 2, 3}));
  EXPECT_EQ(entered({0, 1, 2, 3}, {.nothing = 0}), (std::array<float, 4>{test::kInf, 1, 2, 3}));
  EXPECT_EQ(entered({-0.0f, 1, 2, 3}, {.nothing = 0})[0], test::kInf);
  EXPECT_EQ(entered({0, 1, 1000, 3}, {.nothing = 1000}),
            (std::array<float, 4>{0, 1, test::kInf, 3}));
}

// Memory beside the plane belongs to the host and stays.
TEST(NothingHit, IsMarkedInThePlaneAlone) {
  Plane wide(Rect{0, 0, 6, 1});
  for (int x = 0; x < 6; ++x) wide.view().at(x, 0) = 0;
  View<float> plane = wide.view();
  plane.data += 1;
  plane.window = {0, 0, 4, 1};
  mark_nothing_hit(plane, {.nothing = 0});
  for (int x = 0; x < 6; ++x) {
    EXPECT_EQ(wide.view().at(x, 0), x == 0 || x == 5 ? 0 : test::kInf) << x;
  }
}

TEST(NothingHit, IsMarkedWhateverLiesBetweenThePixels) {
  std::array<float, 8> interleaved{1, -9, 2, -9, 3, -9, 7, -9};
  mark_nothing_hit({interleaved.data(), 2, 8, kRow}, {.nothing = 7});
  EXPECT_EQ(interleaved, (std::array<float, 8>{1, -9, 2, -9, 3, -9, test::kInf, -9}));
}

TEST(NothingHit, AZeroWithoutAlphaIs) {
  DepthSource source;
  source.uncovered = [](int x, int) { return x % 2 == 0; };
  EXPECT_EQ(entered({0, 0, 2, 3}, source), (std::array<float, 4>{test::kInf, 0, 2, 3}));
}

TEST(NothingHit, InEveryKindOfDepth) {
  const Scene scene = test::simple_scene({4, 1});
  Camera gl = *scene.camera, reversed = gl;
  reversed.clip = ClipSpace::kReversed;
  reversed.projection = perspective(0.9, 4, 0.1, 1e3, ClipSpace::kReversed);
  const float stored = 0.25f;
  for (const DepthKind kind : {DepthKind::kEye, DepthKind::kRay, DepthKind::kInverse,
                               DepthKind::kNormalised, DepthKind::kDevice}) {
    for (const Camera* camera : {&gl, &reversed}) {
      DepthSource source{kind, false, 1, 10, camera, kRow};
      EXPECT_TRUE(std::isfinite(entered({0.5f, stored, 0.5f, 0.5f}, source)[1]));
      source.nothing = stored;
      const std::array<float, 4> depths = entered({0.5f, stored, 0.5f, 0.5f}, source);
      EXPECT_EQ(depths[1], test::kInf) << static_cast<int>(kind);
      EXPECT_TRUE(std::isfinite(depths[0])) << static_cast<int>(kind);
    }
  }
}

}  // namespace
}  // namespace limpid

#include "desk/half_plate.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "support.h"

namespace limpid::test {
namespace {

TEST(HalvingTest, TakesInWhatLiesPartlyInAWindow) {
  const Halving halving{10, -4};
  EXPECT_EQ(halving.of({10, -4, 18, 2}), (Rect{0, 0, 4, 3}));
  EXPECT_EQ(halving.of({9, -5, 19, 3}), (Rect{-1, -1, 5, 4}));
  EXPECT_EQ(halving.of({11, -3, 12, -2}), (Rect{0, 0, 1, 1}));
  EXPECT_EQ(halving.covered({-1, 2, 3, 4}), (Rect{8, 0, 16, 4}));
}

struct Windows {
  Rect display, data;
};

class HalfPlateTest : public ::testing::TestWithParam<Windows> {
 protected:
  HalfPlateTest() : buffers_(GetParam().display) {
    const Rect data = GetParam().data;
    const auto some = [](int x, int y) { return noise(x, y, 1); };
    for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
      buffers_.set(id, some, data);
    }
    buffers_.set(
        PlaneId::kDepth, [](int x, int y) { return 3 + noise(x, y, 2); }, data);
  }

  Buffers buffers_;
  std::unique_ptr<Executor> executor_ = make_executor(1);
};

TEST_P(HalfPlateTest, LooksAtTheMiddleOfTheFourPixels) {
  const Scene scene = simple_scene(GetParam().display.size());
  const HalfPlate half(buffers_.frame, *executor_);
  const Camera camera = half.camera(*scene.camera);
  camera.validate();
  const Rect whole = GetParam().display, small = half.frame().display;
  const Rays rays = rays_of(*scene.camera, {whole.width(), whole.height()});
  const Rays half_rays = rays_of(camera, {small.width(), small.height()});
  for (int y = small.y0; y < small.y1; ++y) {
    for (int x = small.x0; x < small.x1; ++x) {
      const Rect four = half.halving().covered({x, y, x + 1, y + 1});
      const glm::dvec3 expected = rays.ray_at(four.x0 + 1 - whole.x0, four.y0 + 1 - whole.y0);
      const glm::dvec3 seen = half_rays.ray_at(x + 0.5 - small.x0, y + 0.5 - small.y0);
      ASSERT_LT(glm::length(seen - expected), 1e-12) << x << ", " << y;
    }
  }
}

TEST_P(HalfPlateTest, ShowsWhateverTheWholeShows) {
  const HalfPlate half(buffers_.frame, *executor_);
  half.frame().validate();
  const Rect work = buffers_.frame.work(), seen = half.halving().covered(half.frame().work());
  EXPECT_EQ(half.frame().work().x0, 0);
  EXPECT_EQ(half.frame().work().y0, 0);
  EXPECT_TRUE(seen.contains(work));
  EXPECT_LE(seen.width(), work.width() + 1);
  EXPECT_LE(seen.height(), work.height() + 1);
}

TEST_P(HalfPlateTest, HasMeansOfLightAndSamplesOfDepth) {
  const HalfPlate half(buffers_.frame, *executor_);
  const View<const float>& color = half.frame().plane(PlaneId::kColorG);
  const View<const float>& depth = half.frame().plane(PlaneId::kDepth);
  const View<const float>& whole = buffers_.frame.plane(PlaneId::kColorG);
  for (int y = color.window.y0; y < color.window.y1; ++y) {
    for (int x = color.window.x0; x < color.window.x1; ++x) {
      const Rect four = intersection(half.halving().covered({x, y, x + 1, y + 1}), GetParam().data);
      double sum = 0;
      for (int j = four.y0; j < four.y1; ++j) {
        for (int i = four.x0; i < four.x1; ++i) sum += whole.at(i, j);
      }
      ASSERT_NEAR(color.at(x, y), sum / static_cast<double>(four.area()), 1e-6);
      ASSERT_EQ(depth.at(x, y), buffers_.frame.plane(PlaneId::kDepth).at(four.x0, four.y0));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, HalfPlateTest,
                         ::testing::Values(Windows{{0, 0, 16, 10}, {0, 0, 16, 10}},
                                           Windows{{0, 0, 15, 9}, {0, 0, 15, 9}},
                                           Windows{{0, 0, 1, 1}, {0, 0, 1, 1}},
                                           Windows{{-3, 5, 12, 14}, {-8, 2, 17, 16}},  // overscan
                                           Windows{{2, 1, 17, 12}, {5, 2, 14, 11}}));

TEST(HalfPlateTest, CountsValidReflectionsAlone) {
  Buffers buffers({0, 0, 4, 2});
  for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
    buffers.fill(id, 1);
  }
  const auto column = [](int x, int) { return static_cast<float>(1 + x); };
  for (const PlaneId id : {PlaneId::kReflectionR, PlaneId::kReflectionG, PlaneId::kReflectionB}) {
    buffers.set(id, column);
  }
  buffers.set(PlaneId::kReflectionValid, [](int x, int) { return x == 1 ? 1.0f : 0.0f; });
  const auto executor = make_executor(1);
  const HalfPlate half(buffers.frame, *executor);
  EXPECT_EQ(half.frame().plane(PlaneId::kReflectionR).at(0, 0), 2);
  EXPECT_EQ(half.frame().plane(PlaneId::kReflectionValid).at(0, 0), 0.5f);
  EXPECT_EQ(half.frame().plane(PlaneId::kReflectionR).at(1, 0), 3.5f);  // no pixel is valid
  EXPECT_EQ(half.frame().plane(PlaneId::kReflectionValid).at(1, 0), 0);
}

TEST(HalfPlateTest, HasUnitNormals) {
  Buffers buffers({0, 0, 2, 2});
  for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
    buffers.fill(id, 1);
  }
  buffers.normal({0, 1, 0});
  buffers.set(PlaneId::kSurfaceNormalX, [](int x, int) { return x == 0 ? 0.6f : 0.0f; });
  buffers.set(PlaneId::kSurfaceNormalY, [](int x, int) { return x == 0 ? 0.8f : 1.0f; });
  const auto executor = make_executor(1);
  const HalfPlate half(buffers.frame, *executor);
  const float x = half.frame().plane(PlaneId::kSurfaceNormalX).at(0, 0);
  const float y = half.frame().plane(PlaneId::kSurfaceNormalY).at(0, 0);
  EXPECT_NEAR(x / y, 0.3 / 0.9, 1e-6);
  EXPECT_NEAR(x * x + y * y, 1, 1e-6);
}

}  // namespace
}  // namespace limpid::test

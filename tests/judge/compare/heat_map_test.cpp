#include "judge/compare/heat_map.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/files/picture/image_file.h"

namespace limpid {
namespace {

using ::testing::ElementsAre;
using Code = std::vector<float>;

const Code kCold = {68, 1, 84}, kMiddle = {33, 145, 140}, kHot = {253, 231, 37},
           kMagenta = {255, 0, 255};

// Tests may run in parallel: each has its own file.
std::filesystem::path scratch_file() {
  return std::filesystem::path(testing::TempDir()) /
         (std::string("limpid_heat_map_") +
          testing::UnitTest::GetInstance()->current_test_info()->name() + ".png");
}

// The 8-bit colors of a one-row heat map of one channel against zero.
std::vector<Code> colors(const std::vector<float>& a, const HeatScale& scale) {
  const std::vector<float> b(a.size(), 0.0f);
  const Rect window{0, 0, static_cast<int>(a.size()), 1};
  const ComparedChannel channel{"Y", {a.data(), 1, 0, window}, {b.data(), 1, 0, window}};
  write_heat_map(scratch_file(), {&channel, 1}, scale);
  const ImageFile image = read_image(scratch_file());
  std::filesystem::remove(scratch_file());
  std::vector<Code> result;
  for (int x = 0; x < window.x1; ++x) {
    Code code;
    for (const Plane& plane : image.planes) code.push_back(255 * plane.view().at(x, 0));
    result.push_back(code);
  }
  return result;
}

TEST(HeatMap, LinearScale) {
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_THAT(colors({0, 1, -2, 3, std::nanf(""), inf}, {.maximum = 2}),
              ElementsAre(kCold, kMiddle, kHot, kHot, kMagenta, kMagenta));
}

TEST(HeatMap, LogarithmicScale) {
  // Four decades up to 10: the middle of the ramp is two decades down.
  EXPECT_THAT(colors({0, 1e-5f, 1e-3f, 0.1f, 10, 1e6f}, {.maximum = 10, .decades = 4}),
              ElementsAre(kCold, kCold, kCold, kMiddle, kHot, kHot));
}

TEST(HeatMap, ShowsTheWorstChannel) {
  const float r[] = {0.25f}, g[] = {-1.0f}, b[] = {0.5f}, zero[] = {0};
  const Rect window{4, 4, 5, 5};
  auto view = [&](const float* p) { return View<const float>{p, 1, 1, window}; };
  const ComparedChannel channels[] = {
      {"R", view(r), view(zero)}, {"G", view(g), view(zero)}, {"B", view(b), view(zero)}};
  write_heat_map(scratch_file(), channels, {.maximum = 2});
  EXPECT_EQ(255 * read_image(scratch_file()).planes[1].view().at(0, 0), kMiddle[1]);
  std::filesystem::remove(scratch_file());
}

TEST(HeatMap, LightnessRises) {
  double last = 0;
  for (int i = 0; i <= 64; ++i) {
    const std::array<float, 3> color = heat_color(i / 64.0);
    const double luma = 0.2126 * std::pow(color[0], 2.2) + 0.7152 * std::pow(color[1], 2.2) +
                        0.0722 * std::pow(color[2], 2.2);
    EXPECT_GT(luma, last) << i;
    last = luma;
  }
  EXPECT_EQ(heat_color(-1), heat_color(0));
  EXPECT_EQ(heat_color(2), heat_color(1));
  EXPECT_EQ(heat_color(std::nan("")), heat_color(0));
}

TEST(HeatMap, RefusesAScaleThatMeansNothing) {
  for (const HeatScale& scale : std::vector<HeatScale>{{.maximum = 0},
                                                       {.maximum = -1},
                                                       {.maximum = std::nan("")},
                                                       {.maximum = 1, .decades = -1},
                                                       {.maximum = 1, .decades = std::nan("")}}) {
    EXPECT_THROW(colors({1}, scale), Error);
  }
  EXPECT_THROW(write_heat_map(scratch_file(), {}), Error);
  EXPECT_FALSE(std::filesystem::exists(scratch_file()));
}

}  // namespace
}  // namespace limpid

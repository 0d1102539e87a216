#include "limpid/files/picture/preview.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/files/picture/image_file.h"

namespace limpid {
namespace {

using ::testing::ElementsAre;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Tests may run side by side: a file for each.
std::filesystem::path scratch_file() {
  return std::filesystem::path(testing::TempDir()) /
         (std::string("limpid_preview_") +
          testing::UnitTest::GetInstance()->current_test_info()->name() + ".png");
}

// The 8-bit codes of a one-row preview whose three planes are the same.
std::vector<float> codes(std::vector<float> values, double stops) {
  const auto path = scratch_file();
  const View<const float> row{values.data(), 1, 0, {0, 0, static_cast<int>(values.size()), 1}};
  write_preview(path, row, row, row, stops);
  const ImageFile image = read_image(path);
  std::vector<float> result;
  for (int x = 0; x < image.window.x1; ++x) {
    result.push_back(255 * image.planes[0].view().at(x, 0));
  }
  std::filesystem::remove(path);
  return result;
}

TEST(Preview, EncodesAsTheStandardSays) {
  EXPECT_EQ(srgb_from_linear(0), 0);
  EXPECT_NEAR(srgb_from_linear(1), 1, 1e-6);
  EXPECT_NEAR(srgb_from_linear(0.0031308f), 0.04045f, 1e-5);
  EXPECT_NEAR(srgb_from_linear(0.18f), 0.461356f, 1e-5);
  EXPECT_NEAR(srgb_from_linear(0.5f), 0.735357f, 1e-5);
  for (int i = 0; i <= 64; ++i) {
    EXPECT_NEAR(linear_from_srgb(srgb_from_linear(static_cast<float>(i) / 64)), i / 64.0, 1e-6);
  }
}

TEST(Preview, ClampsAndRounds) {
  EXPECT_THAT(codes({0, 0.18f, 0.5f, 1, 7, -3}, 0), ElementsAre(0, 118, 188, 255, 255, 0));
  EXPECT_THAT(codes({kInfinity, -kInfinity, std::nanf("")}, 0), ElementsAre(255, 0, 0));
}

TEST(Preview, ExposureIsInStops) {
  EXPECT_THAT(codes({0.09f, 0.36f, 0.25f}, 1), ElementsAre(118, 221, 188));
  EXPECT_THAT(codes({0.36f, 2, 1}, -1), ElementsAre(118, 255, 188));
  EXPECT_THROW(codes({1}, std::nan("")), Error);
  EXPECT_THROW(codes({1}, 101), Error);
}

TEST(Preview, KeepsTheChannelsApart) {
  const auto path = scratch_file();
  const float pixel[] = {1, 0.5f, 0};
  const Rect window{5, 5, 6, 6};
  write_preview(path, {pixel, 1, 1, window}, {pixel + 1, 1, 1, window}, {pixel + 2, 1, 1, window});
  const ImageFile image = read_image(path);
  EXPECT_THAT(image.channels, ElementsAre("R", "G", "B"));
  EXPECT_EQ(image.planes[0].view().at(0, 0), 1);
  EXPECT_EQ(image.planes[1].view().at(0, 0), 188 / 255.0f);
  EXPECT_EQ(image.planes[2].view().at(0, 0), 0);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace limpid

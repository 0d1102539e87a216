#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "limpid/core/frame.h"

namespace limpid {
namespace {

struct Map {
  explicit Map(Size size) {
    for (Plane& plane : planes) plane = Plane({2, 3, 2 + size.width, 3 + size.height});
    for (std::size_t c = 0; c < 3; ++c) texture.channels[c] = planes[c].view();
  }
  void set(int c, int x, int y, float value) {
    planes[static_cast<std::size_t>(c)].view().at(2 + x, 3 + y) = value;
  }
  std::array<Plane, 3> planes;
  Texture texture;
};

TEST(PackBytes, FirstColumnAndRowComeAgainAtTheEnd) {
  Map map({2, 1});
  map.set(0, 0, 0, 1);
  map.set(1, 0, 0, 128 / 255.0f);
  map.set(2, 1, 0, 3 / 255.0f);
  const std::uint32_t left = 255 | 128 << 8, right = 3 << 16;
  EXPECT_EQ(pack_bytes(map.texture),
            (std::vector<std::uint32_t>{left, right, left, left, right, left}));
}

TEST(PackBytes, OnlyWhatEightBitsHoldIsPacked) {
  for (int k = 0; k < 256; ++k) {
    Map map({1, 1});
    map.set(0, 0, 0, static_cast<float>(k) / 255);
    const std::vector<std::uint32_t> texels = pack_bytes(map.texture);
    ASSERT_EQ(texels.size(), 4u) << k;
    EXPECT_EQ(texels[0], static_cast<std::uint32_t>(k));
  }
  for (float other :
       {0.5f / 255, -1 / 255.0f, 256 / 255.0f, 1e-4f, 1e30f, -1e30f, NAN, HUGE_VALF}) {
    Map map({2, 2});
    map.set(2, 1, 1, other);
    EXPECT_TRUE(pack_bytes(map.texture).empty()) << other;
  }
}

}  // namespace
}  // namespace limpid

#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "op/height_bound.h"
#include "support.h"

namespace limpid {
namespace {

struct Highest {
  int value;
  static Highest join(Highest a, Highest b) { return a.value < b.value ? b : a; }
};

// Eight by eight blocks that begin far from the origin; each cell has the number of its block.
TEST(BlockPyramid, TellsOfTheBlocksThatABoxMeets) {
  using Pyramid = BlockPyramid<Highest>;
  Pyramid pyramid;
  pyramid.x0 = -40, pyramid.y0 = 1000;
  std::vector<std::vector<Highest>> levels;
  for (int across = 8; across > 0; across /= 2) {
    std::vector<Highest>& cells = levels.emplace_back();
    for (int i = 0; i < across * across; ++i) {
      const int size = 8 / across, x = i % across, y = i / across;
      cells.push_back({(y * size + size - 1) * 8 + x * size + size - 1});
    }
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    pyramid.levels[i] = {levels[i].data(), 8 >> i};
  }
  const int wide = Pyramid::kWidth, high = Pyramid::kHeight;
  const auto highest = [&](int left, int top, int right, int bottom) {
    const auto x = [&](int block, int texel) { return pyramid.x0 + block * wide + texel; };
    const auto y = [&](int block, int texel) { return pyramid.y0 + block * high + texel; };
    return pyramid.of(x(left, wide - 1), y(top, high - 1), x(right, 0), y(bottom, 0)).value;
  };
  EXPECT_EQ(pyramid.of(-40, 1000, -40, 1000).value, 0);
  EXPECT_EQ(highest(0, 0, 0, 0), 0);
  EXPECT_EQ(highest(3, 5, 4, 6), 6 * 8 + 4) << "no more than it meets";
  EXPECT_EQ(highest(2, 2, 5, 5), 5 * 8 + 5) << "sixteen blocks";
  // Twenty blocks: a cell has four blocks each, so the answer includes some blocks beside the box.
  EXPECT_EQ(highest(2, 2, 6, 5), 5 * 8 + 7);
  EXPECT_EQ(highest(0, 0, 7, 7), 63);
}

TEST(SeenRange, JoinedHoldsBoth) {
  const SeenRange near{2, 3}, far{5, 8}, none{test::kInf, -test::kInf};
  for (const auto& [a, b] : {std::pair{near, far}, {far, near}}) {
    EXPECT_EQ(SeenRange::join(a, b).low, 2);
    EXPECT_EQ(SeenRange::join(a, b).high, 8);
  }
  EXPECT_EQ(SeenRange::join(none, far).low, 5);
  EXPECT_EQ(SeenRange::join(none, far).high, 8);
}

}  // namespace
}  // namespace limpid

#include "complete/mirror_depth.h"

#include <gtest/gtest.h>

#include "complete/shore.h"

// The depth of a mirror that has no rendered depth.

namespace limpid {
namespace {

using test::kInf;

using test::Shore;

constexpr Size kSize = Shore::kSize;

TEST(MirrorDepth, AWallIsSeenUpsideDown) {
  Shore shore;
  const auto executor = make_executor(1);
  const View<const float> depth = shore.made(*executor).depth().view();
  int known = 0;
  for (int y = kSize.height / 2; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      // Edges grow by two pixels, and by rounding perhaps by a third.
      const double expected = shore.mirrored_depth(x, y);
      bool edge = shore.dry_depth(x, y) == 20;
      for (int off = -3; off <= 3; ++off) {
        const int row = std::clamp(y + off, 0, kSize.height - 1);
        edge = edge || shore.mirrored_depth(x, row) != expected;
      }
      if (edge) continue;
      if (std::isinf(expected)) {
        EXPECT_EQ(depth.at(x, y), kInf) << x << ", " << y;
      } else {
        EXPECT_NEAR(depth.at(x, y), expected, 1e-4) << x << ", " << y;
        ++known;
      }
    }
  }
  EXPECT_GT(known, 100);
}

// Where the wall stands before the water, the mirror's camera looked into the wall from below.
TEST(MirrorDepth, InsidesAreNotReal) {
  Shore shore;
  const auto executor = make_executor(1);
  const MirrorDepth& made = shore.made(*executor);
  int insides = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const bool wall = shore.dry_depth(x, y) == 20 && 2 + 20 * shore.ray(x, y).y > 0;
      const bool imaged = made.depth().view().at(x, y) != 20;
      EXPECT_EQ(made.valid().view().at(x, y), wall && imaged ? 0
                                              : wall         ? made.valid().view().at(x, y)
                                                             : 1)
          << x << ", " << y;
      if (!wall || 2 + 20 * shore.ray(x, y).y < 0.5) continue;
      EXPECT_EQ(made.valid().view().at(x, y), 0) << x << ", " << y;
      EXPECT_EQ(made.depth().view().at(x, y), 20) << "a ray that comes there has met the wall";
      ++insides;
    }
  }
  EXPECT_GT(insides, 300);
}

// A wall behind a low bank would be mirrored in the bank's foot.
TEST(MirrorDepth, NothingIsSeenThroughAFoot) {
  Shore shore;
  shore.far = 17;
  shore.top = 0.3;
  const double wall = 30, bottom = shore.deep + 2;
  shore.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    const double sinks = shore.ray(x, y).y, bank = shore.dry_depth(x, y);
    if (!std::isinf(bank)) return static_cast<float>(bank);
    return static_cast<float>(sinks < 0              ? std::min(wall, -bottom / sinks)
                              : 2 + wall * sinks < 9 ? wall
                                                     : HUGE_VAL);
  });
  const auto executor = make_executor(1);
  const MirrorDepth& made = shore.made(*executor);
  int feet = 0, walls = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double water = -2 / shore.ray(x, y).y, depth = made.depth().view().at(x, y);
      const bool foot = shore.dry_depth(x, y) == 17 && water > 17 && water < 1.15 * 17;
      walls += std::abs(depth - wall) < 0.01 ? 1 : 0;
      if (!foot) continue;
      EXPECT_LT(depth, 1.16 * 17) << x << ", " << y;
      ++feet;
    }
  }
  EXPECT_GT(feet, 30);
  EXPECT_GT(walls, 30);
}

// A renderer that draws no backfaces sees through the wall, infinitely far.
TEST(MirrorDepth, AGivenDepthIsMendedOnlyInside) {
  Shore shore;
  const auto wall_before_water = [&](int x, int y) {
    return shore.dry_depth(x, y) == 20 && 2 + 20 * shore.ray(x, y).y > 0;
  };
  shore.buffers.set(PlaneId::kReflectionDepth, [&](int x, int y) {
    return wall_before_water(x, y) ? kInf : 30 + test::noise(x, y, 1);
  });
  shore.buffers.set(PlaneId::kReflectionValid, [](int x, int y) { return test::noise(x, y, 2); });
  const auto executor = make_executor(1);
  const MirrorDepth& made = shore.made(*executor);
  int insides = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const bool wall = wall_before_water(x, y);
      insides += wall ? 1 : 0;
      EXPECT_EQ(made.depth().view().at(x, y), wall ? 20 : 30 + test::noise(x, y, 1));
      EXPECT_EQ(made.valid().view().at(x, y), wall ? 0 : test::noise(x, y, 2));
    }
  }
  EXPECT_GT(insides, 300);
}

// A camera that looks down sees the image of a wall in a smaller scale than the wall. Where the
// wall leaves the picture at its right side, its image goes on to the side; at its left end there
// is sky.
TEST(MirrorDepth, GoesOnToTheSide) {
  constexpr double kAway = 6, kLow = 1, kHigh = 3, kEnd = -2;
  Shore shore;
  shore.scene.camera->view =
      glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 1.5, -1), glm::dvec3(0, 1, 0));
  const auto wall = [&](int x, int y, double side) {
    const glm::dvec3 ray = shore.ray(x, y);
    const double depth = -kAway / ray.z, height = side * (2 + depth * ray.y);
    const bool there = height > kLow && height < kHigh && depth * ray.x > kEnd;
    return ray.z < 0 && there ? depth : HUGE_VAL;
  };
  shore.buffers.set(PlaneId::kDepth,
                    [&](int x, int y) { return static_cast<float>(wall(x, y, 1)); });
  for (int c = 0; c < 3; ++c) {
    shore.buffers.set(plane_after(PlaneId::kReflectionR, c), [&](int x, int y) {
      return std::isinf(wall(x, y, -1)) ? 2.0f : 0.2f + 0.1f * test::noise(x, y, c);
    });
  }
  // Each plane may have its own window.
  View<const float>& blue = shore.buffers.frame.planes[index_of(PlaneId::kReflectionB)];
  blue.window.x1 -= 3;
  const auto executor = make_executor(1);
  const View<const float> depth = shore.made(*executor).depth().view();
  int walls = 0;
  for (int y = 2; y < kSize.height - 2; ++y) {
    EXPECT_EQ(depth.at(0, y), kInf) << y;
    const int right = kSize.width - 1;
    bool all = true, none = true;
    for (int x = right - 8; x <= right; ++x) {
      for (int off = -2; off <= 2; ++off) {
        const bool there = !std::isinf(wall(x, y + off, -1));
        const bool inside = !std::isinf(wall(x, y + off, 1));
        all = all && there, none = none && !there && !inside;
      }
    }
    if (none) {
      EXPECT_EQ(depth.at(right, y), kInf) << y;
    }
    if (!all) continue;
    EXPECT_NEAR(depth.at(right, y), wall(right, y, -1), 0.2) << y;
    ++walls;
  }
  EXPECT_GT(walls, 5);
}

// Far away a row of pixels is hundreds of units of water: the mirror's image of a far bank stands
// right above the bank's line.
TEST(MirrorDepth, ARayAlongTheWaterMeetsAFarBankAtItsLine) {
  Shore shore;
  shore.far = 150;
  shore.top = 60;
  shore.buffers.set(PlaneId::kDepth,
                    [&](int x, int y) { return static_cast<float>(shore.dry_depth(x, y)); });
  shore.buffers.fill(PlaneId::kReflectionDepth, 28000);
  shore.buffers.fill(PlaneId::kReflectionValid, 1);
  const auto executor = make_executor(1);
  const MirrorDepth& made = shore.made(*executor);
  int line = 0, over = 0;
  for (int y = 1; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double height = 2 + 150 * shore.ray(x, y).y;
      const double pixels = height / (150 * (shore.ray(x, y - 1).y - shore.ray(x, y).y));
      const bool bank = shore.dry_depth(x, y) == 150 && height > 0;
      if (std::abs(pixels - 3) < 0.01) continue;
      const bool met = bank && pixels < 3;
      EXPECT_EQ(made.depth().view().at(x, y), met ? 150 : 28000) << x << ", " << y;
      EXPECT_EQ(made.valid().view().at(x, y), met ? 0 : 1) << x << ", " << y;
      line += met ? 1 : 0;
      over += bank && !met ? 1 : 0;
    }
  }
  EXPECT_GT(line, 2 * kSize.width);
  EXPECT_GT(over, 100);
}

// A texel at the line shows a part of what the mirror saw under the object, whatever its depth.
TEST(MirrorDepth, TheTexelAtTheLineIsNotReal) {
  Shore shore;
  shore.buffers.fill(PlaneId::kReflectionDepth, 20);
  shore.buffers.fill(PlaneId::kReflectionValid, 1);
  const auto executor = make_executor(1);
  const MirrorDepth& made = shore.made(*executor);
  int line = 0;
  for (int y = 1; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double height = 2 + 20 * shore.ray(x, y).y;
      const double pixels = height / (20 * (shore.ray(x, y - 1).y - shore.ray(x, y).y));
      const bool at_line = shore.dry_depth(x, y) == 20 && height > 0 && pixels < 1;
      EXPECT_EQ(made.depth().view().at(x, y), 20) << x << ", " << y;
      EXPECT_EQ(made.valid().view().at(x, y), at_line ? 0 : 1) << x << ", " << y;
      line += at_line;
    }
  }
  EXPECT_EQ(line, kSize.width);
}

TEST(MirrorDepth, NothingStandsInTheOpenSea) {
  Shore shore;
  shore.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    const double sinks = shore.ray(x, y).y;
    return sinks < 0 ? static_cast<float>(-5 / sinks) : kInf;
  });
  const auto executor = make_executor(1);
  const MirrorDepth& made = shore.made(*executor);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      EXPECT_EQ(made.depth().view().at(x, y), kInf);
      EXPECT_EQ(made.valid().view().at(x, y), 1);
    }
  }
}

// The nearest surface wins in any order of threads.
TEST(MirrorDepth, ThreadsDoNotMatter) {
  Shore alone, crowd;
  for (Shore* shore : {&alone, &crowd}) {
    shore->buffers.set(PlaneId::kDepth, [](int x, int y) {
      return y < 24 ? 4 + 30 * test::noise(x, y, 1) : 3 + test::noise(x, y, 2);
    });
  }
  const auto one = make_executor(1), four = make_executor(4);
  const MirrorDepth &a = alone.made(*one), &b = crowd.made(*four);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      EXPECT_EQ(a.depth().view().at(x, y), b.depth().view().at(x, y));
      EXPECT_EQ(a.valid().view().at(x, y), b.valid().view().at(x, y));
    }
  }
}

// Threads complete bands of rows, which begin at the upper edge of the reflection.
TEST(MirrorDepth, BandsDoNotMatter) {
  // So few points that holes remain after the first closing.
  const auto noise = [](int x, int y) {
    if (y < 24) return test::noise(x, y, 3) < 0.1f ? 4 + 30 * test::noise(x, y, 1) : kInf;
    return 3 + test::noise(x, y, 2);
  };
  Shore whole;
  whole.buffers.set(PlaneId::kDepth, noise);
  const auto executor = make_executor(2);
  const MirrorDepth& all = whole.made(*executor);
  for (const int begin : {1, 14, 15, 16, 17, 44}) {
    Shore part;
    part.buffers.set(PlaneId::kDepth, noise);
    Frame& frame = part.buffers.frame;
    for (int c = 0; c < 3; ++c) {
      View<const float>& view = frame.planes[index_of(plane_after(PlaneId::kReflectionR, c))];
      view.data += begin * view.y_stride, view.window.y0 = begin;
    }
    const Pass pass(part.scene, frame, 1.333, kWholeState);
    MirrorDepth cut;
    cut.make(frame, pass, *executor);
    // Two rows at the edge of the reflection have fewer neighbours.
    for (int y = begin + 2; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        EXPECT_EQ(cut.depth().view().at(x, y), all.depth().view().at(x, y)) << begin << ", " << y;
        EXPECT_EQ(cut.valid().view().at(x, y), all.valid().view().at(x, y)) << begin << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace limpid

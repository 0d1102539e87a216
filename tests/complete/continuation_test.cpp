#include "complete/continuation.h"

#include <gmock/gmock.h>

#include "complete/pool.h"
#include "op/pixel_start.h"

// Views of a bottom that goes on beyond the picture.

namespace limpid {
namespace {

using test::Pool;

/// Stripes along a level direction, a metre wide each.
auto lanes(double turn) {
  return [=](double x, double z) {
    const double across = std::cos(turn) * x - std::sin(turn) * z;
    return std::abs(across - std::floor(across) - 0.5) < 0.2 ? 0.2 : 0.8;
  };
}

Look going_on(bool goes_on) {
  Look look = test::still_look();
  Refraction::Params& refraction = look.of<Refraction>();
  refraction = {};
  look.of<DepthFog>().distance = DepthFog::Distance::kRefracted;
  if (!goes_on) refraction.off_frame = Refraction::OffFrame::kShorten;
  return look;
}

/// A frame that shows nothing but the row of colors round the picture; a color is its lookup
/// position.
struct RowAlone {
  struct Quad {
    static double weight(int) { return 0.25; }
  };
  static double nearest(PlaneId, Vec2<double>) { return 1; }
  static Quad quad(Vec2<double>) { return {}; }
  static Four<double> read(PlaneId, const Quad&) { return {1, 1, 1, 1}; }
  static Vec2<double> place(PlaneId, const Quad&, int) { return {0, 0}; }
  static Rgb<double> lat_long_rgb(const Texture&, Vec2<double> at) { return {at.x, at.y, 0}; }
};

// The row runs from the upper left corner to the right, down, to the left and up. A bottom that
// goes on in no direction goes on from the nearest place of the edge.
TEST(Continuation, TheRowOfColorsGoesRoundThePicture) {
  const Pool pool;
  const Pass base = pool.pass();
  Continuation on{};
  on.fade = 1e9;
  Pass pass = base;
  pass.continuation = &on;
  const RowRays<double> rays(pass, 24.5);
  Pixel<double> p{};
  begin_pixel(pass, rays, 48.0, 1.0, rays.calm_depth(48.0), 1e3, p);  // of the middle column
  const Bounds bounds{{p.uv.x - 0.04, p.uv.y - 0.03}, {p.uv.x + 0.12, p.uv.y + 0.05}};
  const SeenPlanes planes{PlaneId::kColorR, PlaneId::kDepth, bounds, false};
  const auto seen = [&](Vec3<double> direction) {
    const ScreenRay<double> ray(pass, p, direction);
    return OffFrameRay<double, RowAlone>(pass, planes, p, RowAlone{}, ray, direction, 0.5)
        .look(1e6);
  };
  const double right = seen({1, 0, 0}).shift.x, left = seen({-1, 0, 0}).shift.x;
  EXPECT_NEAR(right, 0.12, 1e-12);
  EXPECT_NEAR(left, -0.04, 1e-12);
  EXPECT_NEAR(seen({0, -1, 0}).shift.y, 0.05, 1e-12);
  EXPECT_NEAR(seen({0, 1, 0}).shift.y, -0.03, 1e-12);
  // The pixel is a quarter of the window's width from its left, 3/8 of its height from its top.
  EXPECT_NEAR(seen({0, 1, 0}).color.r, 0.25 * 0.25, 1e-6);
  EXPECT_NEAR(seen({1, 0, 0}).color.r, 0.25 + 0.25 * 0.375, 1e-6);
  EXPECT_NEAR(seen({0, -1, 0}).color.r, 0.5 + 0.25 * 0.75, 1e-6);
  EXPECT_NEAR(seen({-1, 0, 0}).color.r, 0.75 + 0.25 * 0.625, 1e-6);
}

/// A frame that shows bottom everywhere; a color is the place's square upwards.
struct Slope : RowAlone {
  struct Quad {
    Vec2<double> at;
    static double weight(int) { return 0.25; }
  };
  static Quad quad(Vec2<double> at) { return {at}; }
  static Four<double> read(PlaneId plane, const Quad& quad) {
    const double value = plane == PlaneId::kDepth ? 1e3 : quad.at.y * quad.at.y;
    return {value, value, value, value};
  }
  static Vec2<double> place(PlaneId, const Quad& quad, int) { return quad.at; }
};

TEST(Continuation, AnEdgeIsTheMeanOfTexelsAsFarInwards) {
  const Pool pool;
  Pass pass = pool.pass();
  Continuation on{};
  on.least_drop = 1;
  pass.continuation = &on;
  const RowRays<double> rays(pass, 24.5);
  Pixel<double> p{};
  begin_pixel(pass, rays, 48.0, 1.0, rays.calm_depth(48.0), 1e3, p);
  constexpr double kFalls = 0.5, kBeyond = 0.02;
  const Vec3<double> direction{0, -1, 0};
  const ScreenRay<double> ray(pass, p, direction);
  const double edge = ray.shift_at(on.least_drop / kFalls).y - kBeyond;
  ASSERT_GT(edge, kBeyond);
  const Bounds bounds{{p.uv.x - 1, p.uv.y - 1}, {p.uv.x + 1, p.uv.y + edge}};
  const SeenPlanes planes{PlaneId::kColorR, PlaneId::kDepth, bounds, false};
  for (const double inwards : {0.0, 0.5, 1.0}) {
    on.inwards = inwards;
    const OffFrameRay<double, Slope> beyond(pass, planes, p, Slope{}, ray, direction, kFalls);
    double expected = 0;
    for (const double share : {0.0, 1. / 3, 2. / 3, 1.0}) {
      const double y = edge - share * inwards * kBeyond;
      expected += 0.25 * y * y;
    }
    EXPECT_NEAR(beyond.look(0).color.r, expected, 1e-9) << inwards;
  }
}

const Continuation* made(ContinuationMaker& maker, const Pool& pool) {
  return maker.make(pool.buffers.frame, pool.pass());
}

TEST(Continuation, FollowsTheLinesOfTheBottom) {
  for (const double turn : {-0.5, 0.0, 0.3}) {
    Pool pool;
    pool.draw(lanes(turn));
    ContinuationMaker maker;
    const Continuation* on = made(maker, pool);
    ASSERT_TRUE(on) << turn;
    const glm::dvec3 expected =
        glm::normalize(glm::dvec3(-std::sin(turn), -pool.rise * std::cos(turn), -std::cos(turn)));
    EXPECT_GT(std::abs(glm::dot(on->along, expected)), 0.99) << turn;
  }
}

TEST(Continuation, OnlyABottomWithoutLinesIsBlurred) {
  Pool lines, sand;
  lines.draw(lanes(0.3));
  std::uint32_t state = 1;
  sand.draw([&](double, double) {
    state = 1664525u * state + 1013904223u;
    return 0.4 + 0.2 * (state >> 31);
  });
  ContinuationMaker maker;
  ASSERT_TRUE(made(maker, lines));
  EXPECT_LT(made(maker, lines)->inwards, 0.1);
  ASSERT_TRUE(made(maker, sand));
  EXPECT_GT(made(maker, sand)->inwards, 0.8);
}

TEST(Continuation, ItsColorIsThatOfMostOfTheBottomNearTheEdge) {
  Pool pool;
  pool.draw([](double x, double z) {
    const bool post = std::abs(x) < 0.1 || std::sin(9 * z) > 0.9;
    return post ? 40.0 : x < 0 ? 0.2 : 0.6;
  });
  ContinuationMaker maker;
  const Continuation* on = made(maker, pool);
  ASSERT_TRUE(on);
  // The lower side runs from right to left.
  const View<const float>& red = on->colors.channels[0];
  EXPECT_NEAR(red.at(36, 0), 0.6, 0.01);
  EXPECT_NEAR(red.at(44, 0), 0.2, 0.01);
}

TEST(Continuation, IsNotMadeWhereNothingLooksBeyondThePicture) {
  Pool pool;
  pool.window.y1 += 60;
  pool.draw(lanes(0));
  ContinuationMaker maker;
  EXPECT_FALSE(made(maker, pool));
}

/// Mean error of the transmitted light, against the continued bottom, where rays leave the picture.
double error_beyond(const test::Picture& got, const Pool& pool, double turn) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < Pool::kSize.height; ++y) {
    for (int x = 0; x < Pool::kSize.width; ++x) {
      if (!(pool.ray(x, y).y < -0.05) || !pool.leaves(x, y)) continue;
      const glm::dvec3 at = pool.end(x, y).at;
      sum += std::abs(got.aov(Aov::kTransmitted, x, y) - lanes(turn)(at.x, at.z));
      ++count;
    }
  }
  EXPECT_GT(count, 300);
  return sum / count;
}

TEST(Continuation, LinesGoOnInTheirPerspective) {
  for (const double turn : {0.0, 0.3}) {
    Pool pool;
    pool.draw(lanes(turn));
    const test::Picture on = test::reference(going_on(true), pool.buffers.frame, pool.scene);
    const test::Picture columns = test::reference(going_on(false), pool.buffers.frame, pool.scene);
    EXPECT_LT(error_beyond(on, pool, turn), 0.6 * error_beyond(columns, pool, turn)) << turn;
  }
}

TEST(Continuation, WaysEndOnThePlane) {
  Pool pool;
  pool.draw(lanes(0));
  const test::Picture on = test::reference(going_on(true), pool.buffers.frame, pool.scene);
  for (const int x : {3, 40, 90}) {
    ASSERT_TRUE(pool.leaves(x, Pool::kSize.height - 1));
    EXPECT_NEAR(on.aov(Aov::kPath, x, Pool::kSize.height - 1),
                pool.end(x, Pool::kSize.height - 1).distance, 1e-3);
    EXPECT_EQ(on.aov(Aov::kConfidence, x, Pool::kSize.height - 1), 0);
  }
}

/// Between two banks no plane is the bottom: beyond the picture each bank keeps its height.
TEST(Continuation, BanksGoOnAtTheirHeight) {
  constexpr double kBank = 0.4;
  Pool pool;
  pool.rise = 0;
  pool.draw(lanes(0));
  // The bottom is the higher of the planes y = -deep +- kBank x.
  pool.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    const glm::dvec3 r = pool.ray(x, y);
    const double falls = kBank * std::abs(r.x) - r.y;
    return static_cast<float>(falls > 0 ? (pool.deep + 2) / falls : HUGE_VAL);
  });
  const test::Picture on = test::reference(going_on(true), pool.buffers.frame, pool.scene);
  const int y = Pool::kSize.height - 1;
  double most = 0, sum = 0;
  for (int x = 0; x < Pool::kSize.width; ++x) {
    ASSERT_EQ(on.aov(Aov::kConfidence, x, y), 0) << x;
    const glm::dvec3 r = pool.ray(x, y), point = (-2 / r.y) * r;
    const test::Pool::End level = pool.end(x, y);
    const glm::dvec3 t = (level.at - point) / level.distance;
    const double side = t.x < 0 ? -1 : 1;
    const double distance = (pool.deep - kBank * side * point.x) / (kBank * side * t.x - t.y);
    const double off = std::abs(on.aov(Aov::kPath, x, y) / distance - 1);
    most = std::max(most, off), sum += off;
  }
  // One bank's plane alone is off by 1.5 under the other bank.
  EXPECT_LT(most, 0.2);
  EXPECT_LT(sum / Pool::kSize.width, 0.07);
}

TEST(Continuation, PixelsThatLookIntoThePictureDoNotChange) {
  Pool pool;
  pool.draw(lanes(0.3));
  const test::Picture on = test::fused(going_on(true), pool.buffers.frame, pool.scene);
  const test::Picture columns = test::fused(going_on(false), pool.buffers.frame, pool.scene);
  int changed = 0;
  for (int y = 0; y < Pool::kSize.height; ++y) {
    for (int x = 0; x < Pool::kSize.width; ++x) {
      const bool same = on.color(x, y) == columns.color(x, y);
      changed += !same;
      EXPECT_TRUE(same || columns.aov(Aov::kConfidence, x, y) == 0) << x << ", " << y;
    }
  }
  EXPECT_GT(changed, 300);
}

/// Rays whose end in the picture is a guess, because an object hides the end, do not change either.
TEST(Continuation, GuessesInThePictureDoNotChange) {
  Pool pool;
  pool.draw(lanes(0.3));
  pool.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    const bool post = x > 38 && x < 50 && y > 22 && y < 36;
    return post ? 1.0f : static_cast<float>(pool.dry_depth(x, y));
  });
  const test::Picture on = test::reference(going_on(true), pool.buffers.frame, pool.scene);
  const test::Picture columns = test::reference(going_on(false), pool.buffers.frame, pool.scene);
  int unsure = 0;
  for (int y = 4; y < 36; ++y) {
    for (int x = 20; x < 76; ++x) {
      if (pool.leaves(x, y)) continue;
      unsure += columns.aov(Aov::kConfidence, x, y) == 0;
      EXPECT_EQ(on.color(x, y), columns.color(x, y)) << x << ", " << y;
    }
  }
  EXPECT_GT(unsure, 20);
}

TEST(Continuation, BothRunnersSeeTheSame) {
  Pool pool;
  pool.draw(lanes(0.3));
  const test::Picture judge = test::reference(going_on(true), pool.buffers.frame, pool.scene);
  const test::Picture got = test::fused(going_on(true), pool.buffers.frame, pool.scene, {}, 2);
  int far = 0;
  for (int y = 0; y < Pool::kSize.height; ++y) {
    for (int x = 0; x < Pool::kSize.width; ++x) {
      far += std::abs(judge.color(x, y).r - got.color(x, y).r) > 1e-3;
    }
  }
  EXPECT_LT(far, 5);
}

/// An object before the water at the edge of the picture is no part of the bottom.
TEST(Continuation, WhatStandsAtTheEdgeIsNotDrawnOn) {
  Pool pool;
  pool.draw(lanes(0));
  const auto post = [](int x, int y) { return x > 40 && x < 50 && y > 50; };
  for (int c = 0; c < 3; ++c) {
    const View<const float> dry = pool.buffers.frame.plane(plane_after(PlaneId::kColorR, c));
    test::Buffers with(rect_of(Pool::kSize));
    with.set(plane_after(PlaneId::kColorR, c),
             [&](int x, int y) { return post(x, y) ? 1e3f : dry.at(x, y); });
    pool.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
      return with.frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
    });
  }
  pool.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return post(x, y) ? 1.0f : static_cast<float>(pool.dry_depth(x, y));
  });
  const test::Picture on = test::reference(going_on(true), pool.buffers.frame, pool.scene);
  for (int y = 40; y < Pool::kSize.height; ++y) {
    for (int x = 0; x < Pool::kSize.width; ++x) {
      if (post(x, y) || on.aov(Aov::kConfidence, x, y) > 0) continue;
      EXPECT_LT(on.aov(Aov::kTransmitted, x, y), 1) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace limpid

#include "op/valid_lookup.h"

#include <gtest/gtest.h>

namespace limpid {
namespace {

/// Four texels of the same weight at one place.
struct Tap {
  struct Quad {
    Vec2<double> shift;
    double weight(int) const { return 0.25; }
  };
  Quad quad(Vec2<double> shift) const { return {shift}; }
};

Four<double> all(double count) { return {count, count, count, count}; }

constexpr Vec2<double> kEnd{1, 0};
const auto kFillsNone = [](bool) { return 0.0; };
const auto kFillsHalf = [](bool) { return 0.5; };
const auto kNever = [](bool) { return false; };

// The search begins at the far end: the first valid place lies on the island, at 0.85 ... 0.9 of
// the ray, not on the shore at which the ray begins.
TEST(LastValid, IsTheOneNearestToTheEnd) {
  const auto valid = [](const Tap::Quad& q) {
    return all(q.shift.x <= 0.1 || (q.shift.x > 0.85 && q.shift.x < 0.9) ? 1 : 0);
  };
  EXPECT_NEAR(last_valid(Tap{}, kEnd, 0.0, valid).x, 0.9, 2e-3);
}

TEST(LastValid, IsWhereHalfOfTheWeightIsValid) {
  const auto valid = [](const Tap::Quad& q) { return all(saturate(2 - 2.2 * q.shift.x)); };
  EXPECT_NEAR(last_valid(Tap{}, kEnd, 0.0, valid).x, 1.5 / 2.2, 1e-9);
}

TEST(ValidTaps, WhereAllIsValidArePlainBilinear) {
  const auto valid = [](const Tap::Quad&) { return all(1); };
  const auto taps = valid_taps<double>(Tap{}, kEnd, valid);
  EXPECT_FALSE(taps.made_up);
  EXPECT_EQ(taps.share, 1);
  EXPECT_EQ(taps.filled, 0);
  EXPECT_EQ(taps.weight(), 1);
  EXPECT_EQ(taps.place.x, 1);
}

// A quarter is valid, and half of the rest is filled; the other half comes from the ray.
TEST(ValidTaps, ShareWhatIsMissing) {
  const auto valid = [](const Tap::Quad& q) {
    return q.shift.x > 0.9 ? Four<double>{1, 0, 0, 0} : all(q.shift.x < 0.5 ? 1 : 0);
  };
  const auto taps = valid_taps<double>(Tap{}, kEnd, valid, valid, kFillsHalf, kNever);
  EXPECT_TRUE(taps.made_up);
  EXPECT_EQ(taps.share, 0.25);
  EXPECT_EQ(taps.filled, 0.375);
  EXPECT_NEAR(taps.weight(), 1, 1e-12);
  EXPECT_NEAR(taps.place.x, 1, 1e-12) << "most of the lookup is there";
  EXPECT_NEAR(taps.shortened.shift.x, 0.5, 2e-3);
}

// No other texel is bearable: the whole missing share is filled.
TEST(ValidTaps, WhatStandsInStandsAlone) {
  const auto valid = [](const Tap::Quad& q) {
    return q.shift.x > 0.9 ? Four<double>{1, 0, 0, 0} : all(0);
  };
  const auto none = [](const Tap::Quad&) { return all(0); };
  const auto taps = valid_taps<double>(Tap{}, kEnd, valid, none, kFillsHalf, kNever);
  EXPECT_EQ(taps.share, 0.25);
  EXPECT_EQ(taps.filled, 0.75);
  EXPECT_EQ(taps.weight(), 1);
  // Without a texel that stands in, the last resort has the rest.
  const auto bearable = [](const Tap::Quad&) { return all(1); };
  const auto rest = valid_taps<double>(Tap{}, kEnd, valid, bearable, kFillsNone, kNever);
  EXPECT_EQ(rest.filled, 0);
  EXPECT_NEAR(rest.weight(), 1, 1e-12);
}

TEST(NoTaps, HaveNoWeight) {
  const auto taps = no_taps<double>(Tap{}, kEnd);
  EXPECT_EQ(taps.weight(), 0);
  EXPECT_EQ(taps.share, 0);
  EXPECT_FALSE(taps.made_up);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(taps.weight_there[k], 0);
    EXPECT_EQ(taps.weight_shortened[k], 0);
  }
}

}  // namespace
}  // namespace limpid

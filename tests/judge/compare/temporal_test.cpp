#include "judge/compare/temporal.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

using Values = std::vector<float>;

const float kInf = std::numeric_limits<float>::infinity();
const float kNan = std::nanf("");

ComparedChannel channel(const Values& a, const Values& b, int x0 = 0) {
  const auto row = [x0](const Values& v) -> View<const float> {
    return {v.data(), 1, 0, {x0, 0, x0 + static_cast<int>(v.size()), 1}};
  };
  return {"Y", row(a), row(b)};
}

Flicker flicker_of(const Values& a0, const Values& b0, const Values& a1, const Values& b1) {
  const ComparedChannel now = channel(a0, b0), next = channel(a1, b1);
  return flicker({&now, 1}, {&next, 1});
}

TEST(Flicker, ByHand) {
  // The truth changes by 1, 0, -2, 0; the picture by 1, .5, -1, 0.
  const Flicker f = flicker_of({3, 1, 2, 9}, {0, 0, 4, 7}, {4, 1.5f, 1, 9}, {1, 0, 2, 7});
  EXPECT_EQ(f.mean, (0.5 + 1) / 4);
  EXPECT_EQ(f.rms, std::sqrt(1.25 / 4));
  EXPECT_EQ(f.p99, 1);
  EXPECT_EQ(f.max, 1);
  EXPECT_EQ(f.mismatches, 0);
  EXPECT_EQ(to_text(f), "0.375, RMS 0.559017, 99% 1, max 1");
}

TEST(Flicker, AnErrorThatStaysDoesNotFlicker) {
  const Flicker f = flicker_of({1, 2, 3}, {0, 1, 2}, {6, 0, 9}, {5, -1, 8});
  EXPECT_EQ(f.mean, 0);
  EXPECT_EQ(f.rms, 0);
  EXPECT_EQ(f.max, 0);
  // Changes of the truth itself do not count either, however large.
  EXPECT_EQ(flicker_of({0, 9}, {0, 9}, {9, 0}, {9, 0}).max, 0);
}

TEST(Flicker, NoMismatchLooksGood) {
  for (const auto& [a, b] : std::vector<std::pair<float, float>>{
           {kNan, 0}, {0, kNan}, {kInf, 0}, {kInf, -kInf}, {kNan, kInf}}) {
    for (const bool first : {true, false}) {
      const Flicker f = first ? flicker_of({a, 0}, {b, 0}, {0, 0}, {0, 0})
                              : flicker_of({0, 0}, {0, 0}, {a, 0}, {b, 0});
      EXPECT_EQ(f.mismatches, 1);
      EXPECT_EQ(f.mean, kInf);
      EXPECT_EQ(f.rms, kInf);
      EXPECT_EQ(f.max, kInf);
    }
  }
  EXPECT_EQ(flicker_of({kNan}, {0}, {kNan}, {0}).mismatches, 1);
  EXPECT_EQ(flicker_of({kNan, kInf}, {kNan, kInf}, {2, kInf}, {2, kInf}).max, 0);
}

TEST(Flicker, ClipsBothPicturesFromAbove) {
  const Values zero = {0, 0, 0}, a = {7, kInf, 0.5f}, b = {9, 2, 0.25f};
  const ComparedChannel now = channel(zero, zero), next = channel(a, b);
  const Flicker f = flicker({&now, 1}, {&next, 1}, 1);
  EXPECT_EQ(f.max, 0.25);
  EXPECT_EQ(f.mismatches, 0);
  EXPECT_THROW(flicker({&now, 1}, {&next, 1}, std::nan("")), Error);
}

TEST(Flicker, PercentilesAreExact) {
  Values a(1000, 0.0f), zero(1000, 0.0f);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = static_cast<float>((i * 387) % 1000 + 1);
  EXPECT_EQ(flicker_of(zero, zero, a, zero).p99, 990);
  EXPECT_EQ(flicker_of(a, zero, zero, zero).p99, 990);
}

TEST(Flicker, RefusesFramesThatAreNotAlike) {
  const Values two(2, 0.0f), three(3, 0.0f);
  EXPECT_THROW(flicker_of(two, two, three, three), Error);
  EXPECT_THROW(flicker({}, {}), Error);
  const ComparedChannel now[] = {channel(two, two), channel(two, two)};
  EXPECT_THROW(flicker(now, {now, 1}), Error);
  ComparedChannel other = channel(two, two);
  other.name = "Z";
  EXPECT_THROW(flicker({now, 1}, {&other, 1}), Error);
  const ComparedChannel shifted = channel(two, two, 5);
  EXPECT_THROW(flicker({now, 1}, {&shifted, 1}), Error);
}

}  // namespace
}  // namespace limpid

#include "judge/compare/compare.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

using ::testing::HasSubstr;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const float kNan = std::nanf("");

// A row of pixels that starts at (x0, 3).
View<const float> row(const std::vector<float>& values, int x0 = 0) {
  return {values.data(), 1, 0, {x0, 3, x0 + static_cast<int>(values.size()), 4}};
}

Comparison compare_rows(const std::vector<float>& a, const std::vector<float>& b,
                        const CompareOptions& options = {}) {
  const ComparedChannel channel{"Y", row(a), row(b)};
  return compare({&channel, 1}, options);
}

TEST(Difference, TellsNanAndInfinityApart) {
  EXPECT_EQ(difference(1, 3), 2);
  EXPECT_EQ(difference(-1, 1), 2);
  EXPECT_EQ(difference(0.0f, -0.0f), 0);
  EXPECT_EQ(difference(kInfinity, kInfinity), 0);
  EXPECT_EQ(difference(kNan, kNan), 0);
  EXPECT_EQ(difference(kNan, 1), kInfinity);
  EXPECT_EQ(difference(1, kNan), kInfinity);
  EXPECT_EQ(difference(kNan, kInfinity), kInfinity);
  EXPECT_EQ(difference(kInfinity, kNan), kInfinity);
  EXPECT_EQ(difference(kInfinity, -kInfinity), kInfinity);
  EXPECT_EQ(difference(5, kInfinity), kInfinity);
  EXPECT_EQ(difference(3e38f, -3e38f), 2.0 * 3e38f);  // finite, unlike in float
}

TEST(Compare, OneChannelByHand) {
  const Comparison c = compare_rows({0, 1.5f, 2, -1}, {0, 1, 2, 0}, {.epsilon = 0.25});
  const Metrics& m = c.overall;
  EXPECT_EQ(m.mean, 1.5 / 4);
  EXPECT_EQ(m.rmse, std::sqrt(1.25 / 4));
  EXPECT_EQ(m.rel_mse, (0.25 / 1.25 + 1 / 0.25) / 4);
  EXPECT_EQ(m.psnr, -20 * std::log10(std::sqrt(1.25 / 4)));
  EXPECT_EQ(m.max, 1);
  EXPECT_EQ(m.max_at.x, 3);
  EXPECT_EQ(m.max_at.y, 3);
  EXPECT_EQ(m.max_at.a, -1);
  EXPECT_EQ(m.max_at.b, 0);
  EXPECT_EQ(m.over, 2);
  EXPECT_EQ(m.over_percent, 50);
  EXPECT_EQ(m.mismatches, 0);
  EXPECT_EQ(c.channels[0].rmse, m.rmse);
}

TEST(Compare, EqualPicturesHaveInfinitePsnrAndPassWithNoToleranceAtAll) {
  const std::vector<float> values = {0, -1, kInfinity, -kInfinity, kNan, 1e30f};
  const Comparison c = compare_rows(
      values, values, {.tolerance = {.per_pixel = 0, .allowed_percent = 0, .hard_limit = 0}});
  EXPECT_EQ(c.overall.psnr, kInfinity);
  EXPECT_EQ(c.overall.rmse, 0);
  EXPECT_EQ(c.overall.rel_mse, 0);
  EXPECT_EQ(c.overall.max, 0);
  EXPECT_EQ(c.overall.p99_99, 0);
  EXPECT_EQ(c.overall.both_nan, 1);
  EXPECT_TRUE(c.offenders.empty());
  EXPECT_TRUE(within(c));
}

TEST(Compare, OverallIsOverTheValuesOfAllChannels) {
  const std::vector<float> zero(4, 0.0f), r = {1, 0, 0, 0}, g = {2, 0, 3, 0};
  const ComparedChannel channels[] = {{"R", row(r), row(zero)}, {"G", row(g), row(zero)}};
  const Comparison c = compare(channels);
  EXPECT_EQ(c.channels[0].mean, 0.25);
  EXPECT_EQ(c.channels[1].mean, 1.25);
  EXPECT_EQ(c.overall.mean, 0.75);
  EXPECT_EQ(c.overall.rmse, std::sqrt(14.0 / 8));
  EXPECT_EQ(c.overall.max, 3);
  EXPECT_EQ(c.overall.max_at.channel, 1);
  EXPECT_EQ(c.overall.max_at.x, 2);
  EXPECT_EQ(c.channels[0].over, 1);
  EXPECT_EQ(c.channels[1].over, 2);
  EXPECT_EQ(c.overall.over, 2);  // pixels, not values
  EXPECT_EQ(c.overall.over_percent, 50);
  ASSERT_EQ(c.offenders.size(), 2);
  EXPECT_EQ(c.offenders[0].x, 0);
  EXPECT_EQ(c.offenders[0].channel, 1);
  EXPECT_EQ(c.offenders[0].a, 2);
  EXPECT_EQ(c.offenders[1].x, 2);
}

TEST(Compare, PercentilesAreExact) {
  // 1 ... 20000, in an order without a pattern (7919 shares no factor with 20000).
  std::vector<float> a(20000), b(20000, 0.0f);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = static_cast<float>(i * 7919 % 20000 + 1);
  const Comparison c = compare_rows(a, b);
  EXPECT_EQ(c.overall.p50, 10000);
  EXPECT_EQ(c.overall.p99, 19800);
  EXPECT_EQ(c.overall.p99_99, 19998);
  EXPECT_EQ(c.overall.max, 20000);
  const Comparison one = compare_rows({2}, {0});
  EXPECT_EQ(one.overall.p50, 2);
  EXPECT_EQ(one.overall.p99_99, 2);
  const Comparison two = compare_rows({2, 1}, {0, 0});
  EXPECT_EQ(two.overall.p50, 1);
  EXPECT_EQ(two.overall.p99, 2);
}

TEST(Compare, NoMismatchEverPasses) {
  CompareOptions lax;
  lax.tolerance = {.per_pixel = kInfinity, .allowed_percent = 100, .hard_limit = kInfinity};
  for (const auto& [a, b] : std::vector<std::pair<float, float>>{{kNan, 0},
                                                                 {0, kNan},
                                                                 {kNan, kInfinity},
                                                                 {kInfinity, 0},
                                                                 {0, -kInfinity},
                                                                 {kInfinity, -kInfinity}}) {
    std::vector<float> as(1000, 0.0f), bs(1000, 0.0f);
    as[500] = a;
    bs[500] = b;
    const Comparison c = compare_rows(as, bs, lax);
    EXPECT_FALSE(within(c)) << a << " vs " << b;
    EXPECT_EQ(c.overall.mismatches, 1);
    EXPECT_EQ(c.overall.rmse, kInfinity);
    EXPECT_EQ(c.overall.rel_mse, kInfinity);
    EXPECT_EQ(c.overall.mean, kInfinity);
    EXPECT_EQ(c.overall.psnr, -kInfinity);
    EXPECT_EQ(c.overall.max_at.x, 500);
    EXPECT_EQ(c.overall.p99, 0);
    EXPECT_EQ(c.overall.p99_99, kInfinity);
  }
}

TEST(Compare, EachOfTheThreeNumbersDecides) {
  std::vector<float> a(100, 1.0f), b(100, 1.0f);
  a[3] = 1.25f;
  a[70] = 1.5f;
  auto passes = [&](Tolerance tolerance) {
    return within(compare_rows(a, b, {.tolerance = tolerance}));
  };
  EXPECT_FALSE(passes({}));
  EXPECT_TRUE(passes({.per_pixel = 0.5}));
  EXPECT_FALSE(passes({.per_pixel = 0.25}));
  EXPECT_TRUE(passes({.per_pixel = 0.25, .allowed_percent = 1}));
  EXPECT_FALSE(passes({.per_pixel = 0.125, .allowed_percent = 1}));
  EXPECT_TRUE(passes({.per_pixel = 0.125, .allowed_percent = 2}));
  EXPECT_TRUE(passes({.per_pixel = 0.125, .allowed_percent = 2, .hard_limit = 0.5}));
  EXPECT_FALSE(passes({.per_pixel = 0.125, .allowed_percent = 2, .hard_limit = 0.49}));
}

TEST(Compare, ClipsBothPicturesFromAbove) {
  const Comparison c =
      compare_rows({7, kInfinity, 0.5f, -3, kNan}, {9, 2, 0.25f, -1, kNan}, {.clip = 1});
  EXPECT_EQ(c.channels[0].mean, (0.25 + 2) / 5);
  EXPECT_EQ(c.overall.mismatches, 0);
  EXPECT_FALSE(within(compare_rows({kNan}, {2}, {.clip = 1})));
}

TEST(Compare, KeepsTheFirstFiveOffenders) {
  const std::vector<float> a(8, 1.0f), b(8, 0.0f);
  const ComparedChannel channel{"Y", row(a, -2), row(b, -2)};
  const Comparison c = compare({&channel, 1});
  ASSERT_EQ(c.offenders.size(), 5);
  EXPECT_EQ(c.offenders[0].x, -2);
  EXPECT_EQ(c.offenders[4].x, 2);
  EXPECT_EQ(c.overall.over, 8);
}

TEST(Compare, RefusesWhatCannotBeCompared) {
  const std::vector<float> three(3, 0.0f), four(4, 0.0f);
  EXPECT_THROW(compare({}), Error);
  EXPECT_THROW(compare_rows({}, {}), Error);
  EXPECT_THROW(compare_rows(three, four), Error);
  const ComparedChannel shifted{"Y", row(three), row(three, 1)};
  EXPECT_THROW(compare({&shifted, 1}), Error);
  const ComparedChannel channels[] = {{"R", row(three), row(three)}, {"G", row(four), row(four)}};
  EXPECT_THROW(compare(channels), Error);
  const double nan = std::nan("");
  for (const CompareOptions& options : std::vector<CompareOptions>{
           {.tolerance = {.per_pixel = nan}},
           {.tolerance = {.per_pixel = -1}},
           {.tolerance = {.allowed_percent = nan}},
           {.tolerance = {.allowed_percent = 101}},
           {.tolerance = {.hard_limit = nan}},
           {.epsilon = 0},
           {.epsilon = nan},
           {.clip = nan},
       }) {
    EXPECT_THROW(compare_rows(three, three, options), Error);
  }
}

TEST(CompareText, ShowsItsWork) {
  const std::vector<float> a = {0, 0.5f, 2, kNan}, b = {0, 0.5f, 1, 0}, same(4, 0.25f);
  const ComparedChannel channels[] = {{"R", row(a), row(b)}, {"G", row(same), row(same)}};
  EXPECT_EQ(to_text(compare(channels)), R"(  Mean error = inf
  RMS error = inf
  Relative MSE = inf (epsilon 0.01)
  Peak SNR = -inf
  Max error = inf @ (3, 3, R)  values are nan vs 0
  Percentiles = 0 (50%), inf (99%), inf (99.99%)
  1 values are NaN or inf in one picture only
  channel        mean         RMS    rel. MSE        PSNR         max         50%         99%      99.99%
  R               inf         inf         inf        -inf         inf           0         inf         inf
  G                 0           0           0         inf           0           0           0           0
  2 pixels (50%) over 1e-06; allowed 0%, none over inf
    (2, 3, R)  values are 2 vs 1
    (3, 3, R)  values are nan vs 0
FAILURE
)");
  EXPECT_EQ(to_text(compare({channels + 1, 1}, {.tolerance = {.hard_limit = 0.5}, .clip = 1})),
            R"(  Mean error = 0
  RMS error = 0
  Relative MSE = 0 (epsilon 0.01)
  Peak SNR = inf
  Max error = 0
  Percentiles = 0 (50%), 0 (99%), 0 (99.99%)
  Values above 1 count as that
  channel        mean         RMS    rel. MSE        PSNR         max         50%         99%      99.99%
  G                 0           0           0         inf           0           0           0           0
  0 pixels (0%) over 1e-06; allowed 0%, none over 0.5
PASS
)");
}

}  // namespace
}  // namespace limpid

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "optics/lane_value.h"

namespace limpid {
namespace {

using test::Lane;
using test::value;

// The number header's functions on lanes are as exact as the header says.

TEST(Lanes, SineAndCosineErrorIsAsStated) {
  double sine_worst = 0, cosine_worst = 0;
  for (int i = -500000; i <= 500000; ++i) {
    const double x = static_cast<float>(i * 2e-3);
    sine_worst = std::max(sine_worst, std::abs(value(sin(Lane(x))) - std::sin(x)));
    cosine_worst = std::max(cosine_worst, std::abs(value(cos(Lane(x))) - std::cos(x)));
  }
  std::printf("absolute error of sin %.3g, of cos %.3g\n", sine_worst, cosine_worst);
  EXPECT_LE(sine_worst, 1.5e-7);
  EXPECT_LE(cosine_worst, 1.5e-7);
}

TEST(Lanes, SineAndCosineOfNothing) {
  EXPECT_EQ(value(sin(Lane(0))), 0);
  EXPECT_EQ(value(cos(Lane(0))), 1);
}

TEST(Lanes, ExponentialErrorIsAsStated) {
  double worst = 0;
  for (int i = -87000; i <= 88000; ++i) {
    const double x = static_cast<float>(i * 1e-3);
    worst = std::max(worst, std::abs(value(exp(Lane(x))) / std::exp(x) - 1));
  }
  std::printf("relative error of exp %.3g\n", worst);
  EXPECT_LE(worst, 3e-7);
  EXPECT_EQ(value(exp(Lane(-105))), 0);
}

}  // namespace
}  // namespace limpid

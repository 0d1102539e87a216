#include "limpid/optics/highlight.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support.h"

namespace limpid {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr Vec3<double> kUp{0, 1, 0};

/// In the plane z = 0, so many degrees from straight up towards +x.
Vec3<double> leaning(double degrees) {
  return {std::sin(degrees * kDegree), std::cos(degrees * kDegree), 0};
}

Vec3<double> random_unit(int i, int channel) {
  const auto coordinate = [=](int k) { return 2.0 * test::noise(i, k, channel) - 1; };
  return normalize_or<double>({coordinate(0), coordinate(1), coordinate(2)}, kUp);
}

TEST(Highlight, HandWorkedAngles) {
  // Light at 30 degrees, viewer above: half vector at 15, mirrored light at -30.
  EXPECT_NEAR(blinn_phong_lobe(kUp, kUp, leaning(30), 200.0), 9.743e-4, 1e-6);  // cos(15 deg)^200
  EXPECT_NEAR(phong_lobe(kUp, kUp, leaning(30), 2.0), 0.75, 1e-12);             // cos(30 deg)^2
  EXPECT_NEAR(phong_lobe(kUp, leaning(-30), leaning(30), 200.0), 1, 1e-12);
  EXPECT_NEAR(blinn_phong_lobe(kUp, leaning(-30), leaning(30), 200.0), 1, 1e-12);
  EXPECT_NEAR(blinn_phong_lobe(leaning(25), leaning(10), leaning(40), 1000.0), 1, 1e-12);
}

TEST(Highlight, StaysBetweenZeroAndOneAndSwapsLightAndViewer) {
  for (int i = 0; i < 500; ++i) {
    const Vec3<double> n = random_unit(i, 1), v = random_unit(i, 2), l = random_unit(i, 3);
    for (double power : {0.0, 1.0, 25.0, 200.0, 1e5}) {
      for (auto lobe : {phong_lobe<double>, blinn_phong_lobe<double>}) {
        const double value = lobe(n, v, l, power);
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 1 + 1e-9);
        EXPECT_NEAR(value, lobe(n, l, v, power), 1e-9);
      }
    }
  }
}

TEST(Highlight, LargerPowerIsSharper) {
  for (auto lobe : {phong_lobe<double>, blinn_phong_lobe<double>}) {
    EXPECT_GT(lobe(kUp, kUp, leaning(20), 10.0), lobe(kUp, kUp, leaning(20), 20.0));
    EXPECT_GT(lobe(kUp, kUp, leaning(10), 20.0), lobe(kUp, kUp, leaning(20), 20.0));
  }
}

TEST(Highlight, PowerZeroIsFlat) {
  for (double degrees : {0.0, 40.0, 120.0, 170.0}) {
    EXPECT_EQ(phong_lobe(kUp, kUp, leaning(degrees), 0.0), 1);
    EXPECT_EQ(blinn_phong_lobe(kUp, kUp, leaning(degrees), 0.0), 1);
  }
}

TEST(Highlight, OppositeLightAndViewerGiveNothing) {
  EXPECT_EQ(blinn_phong_lobe(kUp, leaning(90), leaning(-90), 5.0), 0);
  EXPECT_EQ(blinn_phong_lobe(kUp, kUp, Vec3<double>{0, -1, 0}, 5.0), 0);
  EXPECT_EQ(phong_lobe(kUp, kUp, Vec3<double>{0, -1, 0}, 5.0), 0);
}

TEST(Highlight, NothingFromBehindTheSurface) {
  EXPECT_EQ(blinn_phong_lobe(Vec3<double>{0, -1, 0}, kUp, leaning(30), 5.0), 0);
}

}  // namespace
}  // namespace limpid

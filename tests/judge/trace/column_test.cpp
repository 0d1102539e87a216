#include "judge/trace/column.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/absorption.h"
#include "optics/fresnel.h"
#include "optics/refract.h"

namespace limpid::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Equal within a relative tolerance plus three standard errors.
void expect_within(const ColumnLight& got, const Rgb<double>& right, double share) {
  const auto near = [&](double mean, double error, double wanted, const char* channel) {
    EXPECT_NEAR(mean, wanted, share * wanted + 3 * error) << channel;
    EXPECT_LT(error, 0.02 * wanted) << channel;
  };
  near(got.mean.r, got.error.r, right.r, "red");
  near(got.mean.g, got.error.g, right.g, "green");
  near(got.mean.b, got.error.b, right.b, "blue");
}

struct Water {
  Rgb<double> scattering, absorption;
  Rgb<double> straight_deep, real_deep, straight_shallow, real_shallow;
};

/// Values of independent path tracing: water 1 m deep over a bottom of albedo .3, and without a
/// bottom.
constexpr Water kWaters[] = {{{1.5, 1.3, .8},
                              {.22, .3, .7},
                              {.0902, .0724, .0308},
                              {.0621, .0473, .0177},
                              {.0861, .0715, .0331},
                              {.0589, .0467, .0193}},
                             {{.4, .5, .45},
                              {.6, .2, .15},
                              {.0201, .0529, .0592},
                              {.0111, .0326, .0370},
                              {.0265, .0582, .0628},
                              {.0154, .0366, .0401}},
                             {{4, 4.2, 3},
                              {.25, .2, .5},
                              {.1241, .1345, .0850},
                              {.0941, .1050, .0576},
                              {.1223, .1319, .0848},
                              {.0923, .1022, .0574}}};

TEST(Column, SendsWhatPathTracersSayOfMurkyWater) {
  for (const Water& water : kWaters) {
    Column column{.absorption = water.absorption, .scattering = water.scattering};
    for (const bool real : {false, true}) {
      SCOPED_TRACE(real ? "real surface" : "straight");
      column.real_surface = real;
      column.depth = HUGE_VAL;
      column.bottom = {0, 0, 0};
      expect_within(trace_column(column, 100000), real ? water.real_deep : water.straight_deep,
                    0.015);
      column.depth = 1;
      column.bottom = {.3, .3, .3};
      expect_within(trace_column(column, 100000),
                    real ? water.real_shallow : water.straight_shallow, 0.015);
    }
  }
}

/// The deep water of a path-traced picture with its own sun, whose irradiance is 3 (1, .93, .82) /
/// pi.
TEST(Column, SendsWhatAPathTracedPictureShows) {
  Column column{.absorption = {.22, .3, .7}, .scattering = {1.5, 1.3, .8}};
  column.real_surface = false;
  column.irradiance = {3, 3 * .93, 3 * .82};
  expect_within(trace_column(column, 100000), {.2706, .2024, .0759}, 0.02);
}

/// Nothing absorbs light, and the radiance is the same everywhere: the view has this radiance, too.
TEST(Column, KeepsAllLightOfAWhiteFurnace) {
  Column column{.scattering = {1, 1, 1}, .depth = 1.5, .bottom = {1, 1, 1}};
  column.irradiance = {0, 0, 0};
  column.sky = {1, 1, 1};
  const double enters = 1 - fresnel_exact(std::sqrt(0.5), column.ior);
  for (const double g : {0.0, 0.9, -0.5}) {
    column.anisotropy = g;
    for (const bool real : {false, true}) {
      column.real_surface = real;
      column.scattering = {1, 1, 1};
      EXPECT_NEAR(trace_column(column, 500).mean.g, enters, 1e-9);
      // Different channels share paths whose probability differs between the channels.
      column.scattering = {1, 2, 0.5};
      const ColumnLight light = trace_column(column, 100000);
      expect_within(light, enters * Rgb<double>{1, 1, 1}, 0.001);
      EXPECT_NEAR(light.mean.r + light.mean.g + light.mean.b, 3 * enters, 1e-9);
    }
  }
}

/// Chandrasekhar's function of isotropic water, by its integral equation: 1 / H(x) = sqrt(1 - w) +
/// w / 2 integral of y H(y) / (x + y), y = 0 ... 1. Chandrasekhar 1960, "Radiative Transfer".
class HFunction {
 public:
  explicit HFunction(double albedo) : albedo_(albedo) {
    for (int round = 0; round < 200; ++round) {
      std::array<double, kSteps> next;
      for (std::size_t i = 0; i < kSteps; ++i) next[i] = at((double(i) + 0.5) / kSteps);
      for (std::size_t i = 0; i < kSteps; ++i) values_[i] = 0.5 * (values_[i] + next[i]);
    }
  }

  double at(double x) const {
    double sum = 0;
    for (std::size_t i = 0; i < kSteps; ++i) {
      const double y = (double(i) + 0.5) / kSteps;
      sum += y * values_[i] / (x + y) / kSteps;
    }
    return 1 / (std::sqrt(1 - albedo_) + 0.5 * albedo_ * sum);
  }

 private:
  static constexpr std::size_t kSteps = 200;
  static std::array<double, kSteps> ones() {
    std::array<double, kSteps> values;
    values.fill(1);
    return values;
  }
  double albedo_;
  std::array<double, kSteps> values_ = ones();
};

TEST(Column, SendsWhatTheHFunctionSaysOfDeepWater) {
  const double view_sine = std::sqrt(0.5) / 1.333, view = std::sqrt(1 - view_sine * view_sine);
  const double sun = std::sin(50 * kPi / 180);
  const double out = 1 - fresnel_exact(std::sqrt(0.5), 1.333);
  for (const double albedo : {0.3, 0.9, 0.97}) {
    const HFunction h(albedo);
    Column column{.absorption = (1 - albedo) * Rgb<double>{1, 2, 7},
                  .scattering = albedo * Rgb<double>{1, 2, 7}};
    column.real_surface = false;
    const double lit = out * albedo / (4 * kPi) * sun / (view + sun) * h.at(view) * h.at(sun);
    expect_within(trace_column(column, 100000), {lit, lit, lit}, 0.001);
    column.irradiance = {0, 0, 0};
    column.sky = {1, 1, 1};
    const double glow = out * (1 - h.at(view) * std::sqrt(1 - albedo));
    expect_within(trace_column(column, 100000), {glow, glow, glow}, 0.001);
  }
}

/// With scattering and no absorption, the light that reaches a black bottom under ten mean free
/// paths is that of diffusion theory: H(x) / (sqrt(3) (T + 1.4209)) of the light that goes in at x.
/// van de Hulst 1980, "Multiple Light Scattering".
TEST(Column, LosesToABlackBottomWhatDiffusionSays) {
  const double view_sine = std::sqrt(0.5) / 1.333, view = std::sqrt(1 - view_sine * view_sine);
  const double out = 1 - fresnel_exact(std::sqrt(0.5), 1.333);
  Column column{.scattering = {2, 2, 2}, .depth = 5, .real_surface = false};
  column.irradiance = {0, 0, 0};
  column.sky = {1, 1, 1};
  const double lost = HFunction(1).at(view) / (std::sqrt(3.0) * 11.4209);
  expect_within(trace_column(column, 100000), out * (1 - lost) * Rgb<double>{1, 1, 1}, 0.001);
  // With forward scattering light travels as far in five times as many scatterings, except for the
  // first ones.
  column.anisotropy = 0.8;
  column.scattering = {10, 10, 10};
  expect_within(trace_column(column, 20000), out * (1 - lost) * Rgb<double>{1, 1, 1}, 0.004);
}

/// With little scattering the light is that of single scattering: sunlight that is scattered once,
/// in the water or at the bottom.
TEST(Column, SendsWhatTheClosedFormsOfOneScatteringSay) {
  constexpr double kHeight = 35, kIor = 1.333, kDepth = 0.8, kRate = 0.9, kAlbedo = 1e-3;
  const double air = std::sin(kHeight * kPi / 180), inside = refracted_cosine(air, 1 / kIor);
  Column column{.absorption = (1 - kAlbedo) * kRate * Rgb<double>{1, 1, 1},
                .scattering = kAlbedo * kRate * Rgb<double>{1, 1, 1},
                .anisotropy = 0.8,
                .depth = kDepth};
  column.view = column.sun = kHeight;
  const double enters = 1 - fresnel_exact(air, kIor), down = kRate * kDepth / inside;
  const double sun = enters * air / inside, out = enters / (kIor * kIor);
  for (const double azimuth : {0.0, 60.0, 180.0}) {
    column.azimuth = azimuth;
    column.bottom = {0, 0, 0};
    const double level = (1 - inside * inside) * std::cos(azimuth * kPi / 180);
    const double phase = henyey_greenstein(-inside * inside - level, 0.8);
    const double glow = sun * out * phase * kAlbedo * 0.5 * (1 - std::exp(-2 * down));
    expect_within(trace_column(column, 50000), {glow, glow, glow}, 0.002);
    column.bottom = {.2, .2, .2};
    const double lit = sun * out * 0.2 / kPi * inside * std::exp(-2 * down);
    // Then the light that the surface reflects back, a smaller share at each reflection.
    const ColumnLight light = trace_column(column, 50000);
    EXPECT_GT(light.mean.g, lit + glow);
    EXPECT_LT(light.mean.g, (lit + glow) / (1 - 0.4746 * 0.2));
  }
}

/// A bottom at the surface, under water of no thickness: the light of the bottom, and the part that
/// the surface reflects back.
TEST(Column, ShowsABottomAtTheSurface) {
  Column column{.absorption = {1, 1, 1}, .scattering = {1, 5, 0}, .depth = 0};
  column.bottom = {.5, .5, .5};
  column.real_surface = false;
  const double sun = std::sin(50 * kPi / 180), view = std::sqrt(0.5);
  const double out = 1 - fresnel_exact(view, 1.333);
  EXPECT_NEAR(trace_column(column, 10).mean.r, out * 0.5 / kPi * sun, 1e-9);
  column.real_surface = true;
  const double enters = 1 - fresnel_exact(sun, 1.333), square = 1.333 * 1.333;
  const double once = out / square * 0.5 / kPi * enters * sun;
  expect_within(trace_column(column, 100000), once / (1 - 0.4746 * 0.5) * Rgb<double>{1, 1, 1},
                0.001);
}

TEST(Column, EndsWaysThatNothingAbsorbs) {
  Column column{.scattering = {1, 1, 1}};
  column.irradiance = {0, 0, 0};
  column.sky = {1, 1, 1};
  EXPECT_NEAR(trace_column(column, 500).mean.g, 1 - fresnel_exact(std::sqrt(0.5), 1.333), 0.003);
  column.scattering = {0, 0, 0};
  EXPECT_EQ(trace_column(column, 10).mean.g, 0);
  column.sun = -10;
  column.scattering = {1, 0, 1e6};
  column.depth = 1;
  for (const double light : {trace_column(column, 100).mean.r, trace_column(column, 100).mean.b}) {
    EXPECT_GT(light, 0.3);
    EXPECT_LE(light, 2);
  }
}

TEST(Column, IsTheSameForTheSameSeed) {
  const Column column{.absorption = {.1, .2, .3}, .scattering = {1, 1, 1}};
  EXPECT_EQ(trace_column(column, 100, 7).mean, trace_column(column, 100, 7).mean);
  EXPECT_NE(trace_column(column, 100, 7).mean, trace_column(column, 100, 8).mean);
}

}  // namespace
}  // namespace limpid::test

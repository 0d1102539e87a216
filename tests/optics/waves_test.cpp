#include "optics/waves.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/lane_value.h"

namespace limpid {
namespace {

constexpr double kPi = std::numbers::pi;

SineWave wave(double amplitude, double k_x, double k_y, double omega, double phase) {
  SineWave w;
  w.amplitude = amplitude;
  w.k_x = k_x;
  w.k_y = k_y;
  w.omega = omega;
  w.phase = phase;
  return w;
}

const SineWave kWaves[] = {wave(0.2, 1.5, -0.5, 2, 0.3), wave(0.05, -4, 3, 5, 1)};

TEST(Waves, OneSineHandWorked) {
  const SineWave w = wave(0.5, 2, 0, 1, 0);
  const SineWave waves[] = {w};
  const WaveHeight at_rest = wave_height(waves, 0, 9, 0);
  EXPECT_EQ(at_rest.height, 0);
  EXPECT_EQ(at_rest.slope_x, 1);  // 0.5 * 2 * cos 0
  EXPECT_EQ(at_rest.slope_y, 0);
  EXPECT_NEAR(wave_height(waves, kPi / 4, 0, 0).height, 0.5, 1e-15);  // crest
  EXPECT_NEAR(wave_height(waves, kPi / 4, 0, 0).slope_x, 0, 1e-15);
  EXPECT_NEAR(wave_height(waves, 0, 0, kPi / 2).height, -0.5, 1e-15);  // the crest moves to +x
  const Slopes<double> slopes = sine_slopes(wave(0.5, 2, -4, 1, 0), kPi / 3);
  EXPECT_NEAR(slopes.x, 0.5, 1e-15);
  EXPECT_NEAR(slopes.y, -1, 1e-15);
}

TEST(Waves, SlopesAreThoseOfTheHeight) {
  const double step = 1e-5;
  for (double x : {-3.0, 0.2, 7.0}) {
    for (double y : {-1.0, 4.0}) {
      const WaveHeight at = wave_height(kWaves, x, y, 1.7);
      const auto height = [&](double dx, double dy) {
        return wave_height(kWaves, x + dx, y + dy, 1.7).height;
      };
      EXPECT_NEAR((height(step, 0) - height(-step, 0)) / (2 * step), at.slope_x, 1e-8);
      EXPECT_NEAR((height(0, step) - height(0, -step)) / (2 * step), at.slope_y, 1e-8);
    }
  }
}

TEST(Waves, SlopesAddUp) {
  Slopes<double> sum{0, 0};
  for (const SineWave& w : kWaves) {
    const Slopes<double> one = sine_slopes(w, wave_phase(w, 2.0, -3.0, wave_offset(w, 0.4)));
    sum = {sum.x + one.x, sum.y + one.y};
  }
  const WaveHeight whole = wave_height(kWaves, 2, -3, 0.4);
  EXPECT_NEAR(sum.x, whole.slope_x, 1e-15);
  EXPECT_NEAR(sum.y, whole.slope_y, 1e-15);
}

TEST(Waves, APeriodLaterItIsTheSameHoweverLate) {
  for (double periods : {1.0, 1e6}) {
    EXPECT_NEAR(wave_offset(kWaves[0], 0.25 + periods * kPi), wave_offset(kWaves[0], 0.25),
                1e-15 * periods + 1e-15)
        << periods;
  }
}

TEST(Waves, LanesStayNear) {
  using test::Lane, test::value;
  const SineWave& w = kWaves[1];
  const double offset = wave_offset(w, 1e5);
  for (double x = -20; x <= 20; x += 0.37) {
    const Slopes<double> exact = sine_slopes(w, wave_phase(w, x, 2 * x, offset));
    const Slopes<Lane> lane = sine_slopes(w, wave_phase(w, Lane(x), Lane(2 * x), Lane(offset)));
    EXPECT_NEAR(value(lane.x), exact.x, 5e-6);
    EXPECT_NEAR(value(lane.y), exact.y, 5e-6);
  }
}

}  // namespace
}  // namespace limpid

#include "complete/sky.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "complete/shore.h"
#include "optics/clear_sky.h"
#include "support.h"

// The sky behind objects that hide it.

namespace limpid {
namespace {

using test::kInf;

constexpr Rect kWindow{-3, 2, 30, 25};

/// A sky that brightens to the right, before which a block stands.
struct Horizon {
  test::Buffers buffers{kWindow};
  Sky sky;

  explicit Horizon(Rect block = {8, 8, 20, 25}) {
    const auto hides = [=](int x, int y) {
      return x >= block.x0 && x < block.x1 && y >= block.y0 && y < block.y1;
    };
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kColorR, c), [=](int x, int y) {
        return hides(x, y) ? 100.0f : 1 + 0.1f * static_cast<float>(c) + 0.02f * float(x);
      });
    }
    buffers.set(PlaneId::kDepth, [=](int x, int y) { return hides(x, y) ? 7.0f : kInf; });
  }
  float at(int c, int x, int y) const { return sky.color(c).view().at(x, y); }
};

TEST(Sky, IsThePictureWhereThatShowsIt) {
  Horizon horizon;
  const auto executor = make_executor(1);
  ASSERT_TRUE(horizon.sky.make(horizon.buffers.frame, *executor));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(horizon.at(c, 3, 20), 1 + 0.1f * float(c) + 0.02f * 3);
  EXPECT_EQ(horizon.at(0, -3, 2), 1 + 0.02f * -3);
}

// A renderer's depth is from one sample of many: a texel without depth may show half of an object.
TEST(Sky, BesideAThingIsNotThePicture) {
  Horizon horizon;
  const Rect blurred{7, 7, 21, 25};  // the block and a texel around it
  for (int c = 0; c < 3; ++c) {
    horizon.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
      return blurred.contains({x, y, x + 1, y + 1}) ? 50.0f : 1.0f;
    });
  }
  const auto executor = make_executor(1);
  ASSERT_TRUE(horizon.sky.make(horizon.buffers.frame, *executor));
  for (int y = 2; y < 25; ++y) {
    for (int x = -3; x < 30; ++x) EXPECT_NEAR(horizon.at(0, x, y), 1, 0.01) << x << ", " << y;
  }
}

// A sky of which no texel lies beside sky alone counts all the same.
TEST(Sky, OfNarrowGapsIsTheirColor) {
  Horizon gaps;
  gaps.buffers.set(PlaneId::kDepth, [](int x, int) { return x % 3 == 0 ? kInf : 7.0f; });
  for (int c = 0; c < 3; ++c) {
    gaps.buffers.set(plane_after(PlaneId::kColorR, c),
                     [](int x, int) { return x % 3 == 0 ? 1.0f : 100.0f; });
  }
  const auto executor = make_executor(1);
  ASSERT_TRUE(gaps.sky.make(gaps.buffers.frame, *executor));
  for (int x = -3; x < 30; ++x) EXPECT_NEAR(gaps.at(0, x, 4), 1, 1e-5);
}

TEST(Sky, GoesOnBehindThings) {
  Horizon horizon;
  const auto executor = make_executor(1);
  ASSERT_TRUE(horizon.sky.make(horizon.buffers.frame, *executor));
  for (int y = 8; y < 25; ++y) {
    for (int x = 8; x < 20; ++x) {
      // The filled sky lies between the least and the greatest sky, without the block's color.
      EXPECT_GT(horizon.at(0, x, y), 0.9f);
      EXPECT_LT(horizon.at(0, x, y), 1.7f);
    }
  }
  EXPECT_NEAR(horizon.at(0, 13, 9), 1.26f, 0.1f);
}

TEST(Sky, IsNotMadeUpWhereThereIsNone) {
  Horizon horizon(kWindow);
  const auto executor = make_executor(1);
  EXPECT_FALSE(horizon.sky.make(horizon.buffers.frame, *executor));
}

// A transparent film shows no sky, but the color that replaces it.
TEST(Sky, IsNotWhereTheFilmIsTransparent) {
  Horizon horizon;
  horizon.buffers.fill(PlaneId::kColorA, 0);
  const auto executor = make_executor(1);
  EXPECT_FALSE(horizon.sky.make(horizon.buffers.frame, *executor));
  horizon.buffers.set(PlaneId::kColorA, [](int x, int) { return x < 4 ? 1.0f : 0.0f; });
  ASSERT_TRUE(horizon.sky.make(horizon.buffers.frame, *executor));
  EXPECT_LT(horizon.at(0, 29, 3), 1.2f);
}

TEST(Sky, ThreadsDoNotMatter) {
  Horizon alone, crowd;
  const auto one = make_executor(1), four = make_executor(4);
  ASSERT_TRUE(alone.sky.make(alone.buffers.frame, *one));
  ASSERT_TRUE(crowd.sky.make(crowd.buffers.frame, *four));
  for (int y = kWindow.y0; y < kWindow.y1; ++y) {
    for (int x = kWindow.x0; x < kWindow.x1; ++x) EXPECT_EQ(alone.at(1, x, y), crowd.at(1, x, y));
  }
}

TEST(Sky, OfOneColorReplacesASkyThatIsNotSeen) {
  Horizon horizon(kWindow);
  const auto executor = make_executor(2);
  horizon.sky.make_even(horizon.buffers.frame, {0.25, 0.5, 1}, *executor);
  EXPECT_EQ(horizon.sky.color(0).view().window, kWindow);
  for (const auto& [x, y] : {std::pair{-3, 2}, {29, 24}}) {
    EXPECT_EQ(horizon.at(0, x, y), 0.25f);
    EXPECT_EQ(horizon.at(1, x, y), 0.5f);
    EXPECT_EQ(horizon.at(2, x, y), 1.0f);
  }
}

// --- beyond the picture --------------------------------------------------------------------------

constexpr Size kView{64, 72};

/// A camera two metres above calm water, 15 degrees down, under a sky that changes by multiples of
/// a clear sky's change with elevation, of red and of the other colors, and of its change with the
/// angle to a sun above the picture.
struct Evening {
  test::Buffers buffers{rect_of(kView)};
  Scene scene = test::simple_scene(kView);
  double fall = 1, other = 0, glow = 0;
  glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.3, 0.4, -1));

  Evening() {
    scene.camera->view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 2 - std::tan(0.2618), -1),
                                     glm::dvec3(0, 1, 0));
    scene.sun = Sun{to_sun, {3, 3, 3}};
    draw([](int, int) { return 0.0; });
  }
  glm::dvec3 ray(double x, double y) const {
    return glm::normalize(rays_of(*scene.camera, {kView.width, kView.height}).ray_at(x, y));
  }
  /// The logarithm of the sky's light, of red and of the other colors.
  double log_at(const glm::dvec3& direction, bool red) const {
    return (red ? fall : other) * clear_sky_by_elevation(direction.y) +
           (red ? glow : 0) * clear_sky_by_sun(glm::dot(to_sun, direction));
  }
  template <class Clouds>
  void draw(Clouds&& clouds) {
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
        const glm::dvec3 direction = ray(x + 0.5, y + 0.5);
        return static_cast<float>(
            direction.y > 0 ? std::exp(log_at(direction, c == 0) + (c == 0 ? clouds(x, y) : 0))
                            : 0.5);
      });
    }
    buffers.set(PlaneId::kDepth, [&](int x, int y) {
      const auto rays = rays_of(*scene.camera, {kView.width, kView.height});
      const double rise = rays.ray_at(x + 0.5, y + 0.5).y;
      return rise < 0 ? static_cast<float>(-4 / rise) : kInf;
    });
  }
  SkyChange change() const {
    return sky_change(buffers.frame, Pass(scene, buffers.frame, 1.333, {}));
  }
};

TEST(Sky, TellsHowItChangesWithElevation) {
  const auto none = [](int, int) { return 0.0; };
  Evening evening;
  EXPECT_NEAR(evening.change().with_elevation.r, 1, 1e-4);
  EXPECT_EQ(evening.change().with_elevation.g, 0);
  EXPECT_EQ(evening.change().with_sun.r, 0);
  // Brighter higher up: only as far as all colors are.
  evening.fall = -1;
  evening.draw(none);
  EXPECT_NEAR(evening.change().with_elevation.r, 0, 1e-4);
  evening.other = -0.3;
  evening.draw(none);
  EXPECT_NEAR(evening.change().with_elevation.r, -0.3, 1e-4);
  EXPECT_NEAR(evening.change().with_elevation.b, -0.3, 1e-4);
  evening.fall = evening.other = -2;
  evening.draw(none);
  EXPECT_EQ(evening.change().with_elevation.g, -kMostSkyGain);
  evening.fall = 30, evening.other = 0;
  evening.draw(none);
  EXPECT_EQ(evening.change().with_elevation.r, kMostSkyFall);
  // Clouds from one pixel to the next: little is known.
  evening.fall = 0.3;
  evening.draw([](int x, int y) { return (x + y) % 2; });
  EXPECT_NEAR(evening.change().with_elevation.r, 0, 0.1);
  // Surfaces, and what is black or no number, tell nothing.
  evening.buffers.fill(PlaneId::kColorR, 0);
  EXPECT_EQ(evening.change().with_elevation.r, 0);
  evening.buffers.fill(PlaneId::kColorR, std::nanf(""));
  EXPECT_EQ(evening.change().with_elevation.r, 0);
  evening.draw(none);
  evening.buffers.fill(PlaneId::kDepth, 5);
  EXPECT_EQ(evening.change().with_elevation.r, 0);
}

TEST(Sky, TellsHowItChangesAroundTheSun) {
  Evening evening;
  evening.fall = evening.glow = 0.7;
  evening.draw([](int, int) { return 0.0; });
  EXPECT_NEAR(evening.change().with_elevation.r, 0.7, 1e-4);
  EXPECT_NEAR(evening.change().with_sun.r, 0.7, 1e-4);
  EXPECT_EQ(evening.change().with_sun.g, 0);
  evening.fall = evening.glow = 1.3;
  evening.draw([](int, int) { return 0.0; });
  EXPECT_NEAR(evening.change().with_elevation.r, 1.3, 1e-4);
  EXPECT_EQ(evening.change().with_sun.r, kMostSkyGlow);
  // Without a sun it is a sky that changes to the sides, too.
  evening.scene.sun.reset();
  EXPECT_EQ(evening.change().with_sun.r, 0);
}

// The mean of the standard clear sky over a level surface, by its own formula and other directions.
TEST(Sky, LightsLevelWaterAsAllOfIt) {
  const auto radiance = [](const Evening& e) {
    return shown_sky_radiance(e.buffers.frame, Pass(e.scene, e.buffers.frame, 1.333, {}));
  };
  Evening evening;
  EXPECT_NEAR(radiance(evening)->g, 1, 1e-6);
  evening.fall = evening.glow = 0.9;
  evening.draw([](int, int) { return 0.0; });
  constexpr int kRows = 200, kColumns = 400;
  double light = 0, weights = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double rise = (row + 0.5) / kRows * std::numbers::pi / 2;
      const double turn = (column + 0.5) / kColumns * 2 * std::numbers::pi;
      const glm::dvec3 direction(std::cos(rise) * std::cos(turn), std::sin(rise),
                                 std::cos(rise) * std::sin(turn));
      const double weight = std::sin(rise) * std::cos(rise);
      light += weight * std::exp(evening.log_at(direction, true));
      weights += weight;
    }
  }
  EXPECT_NEAR(radiance(evening)->r, light / weights, 0.01 * light / weights);
  // Half of the texels are black, or all of them in a color.
  evening.fall = evening.glow = 0;
  evening.draw([](int x, int) { return x % 2 == 0 ? 0.0 : -1e4; });
  EXPECT_NEAR(radiance(evening)->r, 0.5, 1e-6);
  EXPECT_NEAR(radiance(evening)->g, 1, 1e-6);
  evening.buffers.fill(PlaneId::kColorB, 0);
  EXPECT_EQ(radiance(evening)->b, 0);
  evening.buffers.fill(PlaneId::kDepth, 5);
  EXPECT_FALSE(radiance(evening));
}

TEST(Sky, GoesOnToChangeAboveThePicture) {
  for (const double glow : {0.0, 1.0}) {
    Evening evening;
    evening.glow = glow;
    evening.draw([](int, int) { return 0.0; });
    Look look = test::still_look();
    FresnelReflection::Params& mirror = look.of<FresnelReflection>();
    mirror.reflectance = FresnelReflection::Reflectance::kRim, mirror.power = 0;
    mirror.lookup = FresnelReflection::Lookup::kRay;
    mirror.source = FresnelReflection::Source::kAuto;
    look.of<SunHighlight>().strength = 0;
    const test::Picture wet = test::reference(look, evening.buffers.frame, evening.scene);
    const int x = kView.width / 2;
    int above = 0;
    for (int y = 0; y < kView.height; ++y) {
      glm::dvec3 mirrored = evening.ray(x + 0.5, y + 0.5);
      mirrored.y = -mirrored.y;
      if (mirrored.y < 0.02) continue;
      const double expected = std::exp(evening.log_at(mirrored, true));
      EXPECT_NEAR(wet.aov(Aov::kReflected, x, y), expected, 0.02 * expected) << glow << ", " << y;
      EXPECT_NEAR(wet.aov(Aov::kReflected, x, y, 1), 1, 1e-3) << y;
      if (mirrored.y > evening.ray(x + 0.5, 0).y + 0.1) ++above;
    }
    EXPECT_GT(above, 10);
  }
}

/// The guess for a picture of the horizon, over level water of the scene.
Rgb<double> guess(const Horizon& horizon, const Scene& scene = test::Shore::seen_from()) {
  return guessed_sky(horizon.buffers.frame, Pass(scene, horizon.buffers.frame, 1.333, kWholeState));
}

TEST(Sky, IsGuessedFromTheBrightnessOfTheGround) {
  Horizon horizon({-3, 10, 30, 25});
  const auto set = [&](float r, float g, float b) {
    horizon.buffers.fill(PlaneId::kColorR, r).fill(PlaneId::kColorG, g).fill(PlaneId::kColorB, b);
  };
  set(0.1f, 0.2f, 0.3f);
  const Rgb<double> sky = guess(horizon);
  EXPECT_NEAR(sky.r, 0.4, 1e-6);
  EXPECT_EQ(sky.r, sky.g);
  EXPECT_EQ(sky.r, sky.b);
  // Neither the sky above nor what is no number counts, and a lamp only by its root.
  horizon.buffers.set(PlaneId::kColorR, [](int x, int y) {
    return y < 10 ? 50.0f : x == 0 ? std::nanf("") : x == 1 && y == 12 ? 1e4f : 0.1f;
  });
  EXPECT_NEAR(guess(horizon).r, 0.5, 0.15);
  set(-1, -1, -1);
  EXPECT_EQ(guess(horizon).r, 0);
}

TEST(Sky, IsGuessedFromTheSunAsWell) {
  Horizon horizon({-3, 10, 30, 25});
  for (int c = 0; c < 3; ++c) horizon.buffers.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  Scene scene = test::Shore::seen_from();
  const auto with_sun = [&](double elevation, double color) {
    scene.sun = Sun{.direction = {std::cos(elevation), std::sin(elevation), 0},
                    .color = {color, color, color}};
    return guess(horizon, scene);
  };
  // An albedo of a half needs a sky of 1 without a sun, and of .75 with a quarter from above.
  constexpr double kAbove = std::numbers::pi / 2;
  EXPECT_NEAR(with_sun(kAbove, 0.25).b, std::sqrt(0.75), 1e-6);
  EXPECT_NEAR(with_sun(std::numbers::pi / 6, 0.25).b, std::sqrt(0.875), 1e-6);
  // A clear sky sends a level surface .1 to .2 of the sun's light if the sun is high, and is blue.
  const Rgb<double> clear = with_sun(kAbove, 1);
  EXPECT_GT(clear.r * clear.r, 0.1);
  EXPECT_LT(clear.g * clear.g, 0.2);
  EXPECT_GT(clear.b, 1.2 * clear.r);
  // The guess is no brighter than without a sun, whatever the sun.
  for (const double elevation : {-0.3, 0.0, 1e-9, 0.01, 0.1}) {
    for (const double color : {0.0, 1e-30, 1.0, Sun::kBrightest}) {
      const Rgb<double> sky = with_sun(elevation, color);
      EXPECT_LE(sky.b, 1 + 1e-6) << elevation << ", " << color;
      EXPECT_GE(sky.b, 0.05) << elevation << ", " << color;
    }
  }
  EXPECT_NEAR(with_sun(-0.3, 1).g, 1, 1e-6);
}

TEST(Sky, IsBlackOverNothing) {
  Horizon horizon({0, 0, 0, 0});
  EXPECT_EQ(guess(horizon).g, 0);
}

}  // namespace
}  // namespace limpid

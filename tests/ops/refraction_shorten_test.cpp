#include <algorithm>
#include <cmath>

#include "limpid/ops/refraction.h"

#include "ops/tray.h"

// Rejection `shorten`: an object before the water is never seen through the water, and no color
// jumps.

namespace limpid {
namespace {

using test::Tray;

constexpr Size kSize{48, 40};
constexpr float kForeground = 1e4f;

/// Posts of a checker pattern before a bright bottom; any texel of a post would be visible at once.
bool post(int x, int y) { return (x / 6 + y / 5) % 2 == 0; }

Tray checker_tray(double amount, int seed, double change = 0) {
  Tray tray(kSize);
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
      return post(x, y) ? kForeground : 0.5f + 0.5f * std::sin(0.2f * float(x + 2 * y + c));
    });
  }
  tray.buffers.set(PlaneId::kDepth, [](int x, int y) { return post(x, y) ? 8.f : 12.f; });
  const auto normal = [=](int x, int y, int c) {
    const double a = amount * (test::noise(x, y, seed) - 0.5) + change;
    const double b = amount * (test::noise(x, y, seed + 1) - 0.5) - change;
    const double scale = 1 / std::sqrt(1 + a * a + b * b);
    return static_cast<float>(scale * (c == 0 ? a : c == 1 ? 1 : b));
  };
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kSurfaceNormalX, c),
                     [=](int x, int y) { return normal(x, y, c); });
  }
  Refraction::Params& p = tray.look.of<Refraction>();
  p.model = Refraction::Model::kNormalOffset;
  p.rejection = Refraction::Rejection::kShorten;
  p.strength = 0.2;
  tray.look.of<PrismSplit>().strength = 0.1;
  return tray;
}

void expect_no_foreground(const test::Picture& got, const char* what) {
  int made_up = 0;
  each_wet(got, kSize, [&](int x, int y) {
    for (int c = 0; c < 3; ++c) {
      ASSERT_LE(got.aov(Aov::kTransmitted, x, y, c), 1.0) << what << " at " << x << ", " << y;
    }
    const double sure = got.aov(Aov::kConfidence, x, y);
    ASSERT_TRUE(sure >= 0 && sure <= 1 + 1e-6) << what;
    made_up += sure < 0.5;
  });
  EXPECT_GT(made_up, 20) << what << ": the test must meet foreground";
}

TEST(Shorten, NoForegroundInAnyChannelForAnyNormalAndStrength) {
  for (int seed = 0; seed < 4; ++seed) {
    for (double strength : {0.05, 0.3, 5.0}) {
      for (auto off_frame : {Refraction::OffFrame::kClamp, Refraction::OffFrame::kShorten,
                             Refraction::OffFrame::kFog, Refraction::OffFrame::kContinue}) {
        Tray tray = checker_tray(1, 100 + 2 * seed);
        tray.look.of<Refraction>().strength = strength;
        tray.look.of<Refraction>().off_frame = off_frame;
        expect_no_foreground(tray.wet(), "reference");
        expect_no_foreground(test::fused(tray.look, tray.buffers.frame, tray.scene), "fused");
      }
    }
  }
}

TEST(Shorten, NoForegroundAlongSnellsRaysEither) {
  for (int steps : {Refraction::kMarch, 0, 1, 4}) {
    Tray tray = checker_tray(1.5, 7);
    tray.look.of<Refraction>().model = Refraction::Model::kSnell;
    tray.look.of<Refraction>().steps = steps;
    tray.look.of<PrismSplit>().model = PrismSplit::Model::kDispersion;
    tray.look.of<PrismSplit>().gain = 20;
    const test::Picture got = tray.wet();
    each_wet(got, kSize, [&](int x, int y) {
      for (int c = 0; c < 3; ++c) ASSERT_LE(got.aov(Aov::kTransmitted, x, y, c), 1.0);
    });
  }
}

// Colors change by at most 0.2 a texel; an offset moves by strength x width x 1e-4 = 1e-3 texels.
// Shortening may move faster than the offset, by a factor that the geometry bounds.
TEST(Shorten, NothingJumpsAtSilhouettes) {
  constexpr double kChange = 1e-4;
  const auto jump = [&](Refraction::Rejection rejection) {
    double largest = 0;
    for (int seed = 0; seed < 3; ++seed) {
      Tray one = checker_tray(0.6, 30 + 2 * seed), two = checker_tray(0.6, 30 + 2 * seed, kChange);
      for (Tray* tray : {&one, &two}) {
        tray->look.of<Refraction>().rejection = rejection;
        // One post before a bottom with a gradient.
        tray->buffers.set(PlaneId::kDepth,
                          [](int x, int) { return x >= 20 && x < 28 ? 8.f : 12.f; });
        for (int c = 0; c < 3; ++c) {
          tray->buffers.set(plane_after(PlaneId::kColorR, c), [](int x, int y) {
            return x >= 20 && x < 28 ? kForeground : 0.02f * float(x) + 0.01f * float(y);
          });
        }
      }
      const test::Picture a = one.wet(), b = two.wet();
      each_wet(a, kSize, [&](int x, int y) {
        for (int c = 0; c < 3; ++c) {
          largest = std::max(largest, std::abs(a.color(x, y).r - b.color(x, y).r));
          largest = std::max(largest, std::abs(a.color(x, y).g - b.color(x, y).g));
          largest = std::max(largest, std::abs(a.color(x, y).b - b.color(x, y).b));
        }
      });
    }
    return largest;
  };
  EXPECT_LT(jump(Refraction::Rejection::kShorten), 50 * kChange);
  EXPECT_GT(jump(Refraction::Rejection::kSnap), 500 * kChange) << "the article's halo, kept";
}

TEST(Shorten, WithoutForegroundItIsPlainFiltering) {
  Tray tray = checker_tray(1, 3);
  tray.buffers.fill(PlaneId::kDepth, 12);
  tray.look.of<Refraction>().strength = 0.01;
  tray.look.of<PrismSplit>().strength = 0.005;
  const test::Picture shortened = tray.wet();
  tray.look.of<Refraction>().rejection = Refraction::Rejection::kNone;
  const test::Picture plain = tray.wet();
  for (int y = 2; y + 2 < kSize.height; ++y) {
    for (int x = 2; x + 2 < kSize.width; ++x) {
      const Rgb<double> a = rgb_of(shortened, Aov::kTransmitted, x, y);
      test::expect_rgb(a, rgb_of(plain, Aov::kTransmitted, x, y), 1e-2 * (1 + a.r));
    }
  }
}

// The eye sees a post; the offset would end in its middle.
TEST(Shorten, TheOffsetEndsAtTheEdgeOfThePost) {
  Tray tray({40, 4});
  tray.buffers.set(PlaneId::kColorR,
                   [](int x, int) { return x >= 20 && x < 30 ? 99.f : float(x); });
  tray.buffers.set(PlaneId::kDepth, [](int x, int) { return x >= 20 && x < 30 ? 8.f : 12.f; });
  tray.buffers.normal({0.6, 0.8, 0});
  Refraction::Params& p = tray.look.of<Refraction>();
  p.rejection = Refraction::Rejection::kShorten;
  p.strength = 8 / 40.0 / 0.6;  // 8 texels to the right
  const test::Picture got = tray.wet();
  EXPECT_NEAR(got.aov(Aov::kTransmitted, 5, 1), 13, 1e-5);
  EXPECT_EQ(got.aov(Aov::kConfidence, 5, 1), 1);
  EXPECT_NEAR(got.aov(Aov::kTransmitted, 17, 1), 19, 1e-3);  // 25 is post: the last texel before it
  EXPECT_NEAR(got.aov(Aov::kConfidence, 17, 1), 0, 1e-6);
  EXPECT_NEAR(got.aov(Aov::kStmapR, 17, 1, 0), (19.5 + 0.5) / 40, 1e-3);  // half a valid texel
}

/// A layer below that is cut at the crests of waves has objects that stand out of the water in a
/// trough.
TEST(Shorten, WhatALayerBelowHasAboveTheSurfaceDoesNotCount) {
  Tray tray = checker_tray(1, 11);
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kBelowR, c),
                     [](int x, int) { return x < 30 ? 1.0f : 100.0f; });
  }
  tray.buffers.set(PlaneId::kBelowDepth, [](int x, int) { return x < 30 ? 12.0f : 9.99f; });
  tray.buffers.set(PlaneId::kDepth, [](int x, int) { return x < 30 ? 12.0f : 9.99f; });
  const test::Picture got = tray.wet();
  each_wet(got, kSize, [&](int x, int y) {
    EXPECT_NEAR(got.aov(Aov::kTransmitted, x, y, 0), 1, 1e-5) << x << ", " << y;
  });
}

TEST(Shorten, ALayerBelowNeedsNoRejection) {
  Tray tray = checker_tray(1, 11);
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kBelowR, c),
                     [=](int x, int) { return float(c + 1) + 0.01f * float(x); });
  }
  tray.buffers.fill(PlaneId::kBelowDepth, 12);
  for (auto rejection : {Refraction::Rejection::kNone, Refraction::Rejection::kSnap,
                         Refraction::Rejection::kShorten}) {
    tray.look.of<Refraction>().rejection = rejection;
    const test::Picture got = tray.wet();
    each_wet(got, kSize, [&](int x, int y) {
      for (int c = 0; c < 3; ++c) {
        ASSERT_GE(got.aov(Aov::kTransmitted, x, y, c), c + 1);
        ASSERT_LE(got.aov(Aov::kTransmitted, x, y, c), c + 1.5);
      }
    });
  }
}

/// A ray from shallow water that ends deep, below an object that stands out of the water. No texel
/// along the ray is far enough for the ray's end: the pixel's own texel of the layer below stands
/// in, not the dry picture.
TEST(Shorten, AShallowLayerBelowStandsInForADeepEnd) {
  Tray tray(kSize);
  tray.buffers.fill(PlaneId::kDepth, 30);
  tray.buffers.set(PlaneId::kBelowDepth, [](int x, int) { return x < 20 ? 10.5f : 9.0f; });
  for (int c = 0; c < 3; ++c) tray.buffers.fill(plane_after(PlaneId::kBelowR, c), 0.25f);
  tray.look.of<Refraction>() = {.rejection = Refraction::Rejection::kShorten, .steps = 1};
  // Leaning by 36.9 degrees, a facet bends the ray by 10.1, which is 3.6 columns at a depth of 20.
  for (const double lean : {-0.6, 0.6}) {
    tray.buffers.normal({lean, 0.8, 0});
    const test::Picture got = tray.wet();
    for (const int x : {17, 18, 19}) EXPECT_NEAR(got.aov(Aov::kTransmitted, x, 9), 0.25, 1e-6) << x;
  }
}

/// Water is endless only where the dry picture has hit nothing, either.
TEST(Shorten, WhereALayerBelowIsEmptyTheDryPictureStays) {
  Tray tray(kSize);
  tray.buffers.set(PlaneId::kDepth, [](int x, int y) { return x + y < 1 ? test::kInf : 14.0f; });
  tray.buffers.set(PlaneId::kBelowDepth, [](int x, int) { return x < 20 ? test::kInf : 14.0f; });
  for (int c = 0; c < 3; ++c) tray.buffers.fill(plane_after(PlaneId::kBelowR, c), 0.25f);
  for (const auto model : {Refraction::Model::kNormalOffset, Refraction::Model::kSnell}) {
    tray.look.of<Refraction>() = {.model = model, .rejection = Refraction::Rejection::kShorten};
    const test::Picture got = tray.wet();
    EXPECT_EQ(got.aov(Aov::kTransmitted, 0, 0), 0);
    for (int x = 5; x < 40; ++x) {
      EXPECT_NEAR(got.aov(Aov::kTransmitted, x, 20), x < 20 ? 0.5 : 0.25, 1e-6) << x;
      EXPECT_TRUE(std::isfinite(got.aov(Aov::kPath, x, 20))) << x;
    }
  }
}

/// Rays along one axis that end 0.02 of the picture beyond its last texels lose 20 times 0.02 of
/// the light.
TEST(Shorten, OffTheFrameFogIsByTheWayOfAllColors) {
  for (const bool down : {false, true}) {
    Tray tray({20, 20});
    tray.buffers.normal(down ? Vec3<double>{0, 0.8, 0.6} : Vec3<double>{0.6, 0.8, 0});
    tray.look.of<PrismSplit>() = {PrismSplit::Model::kDispersion, 0, 1};
    Refraction::Params& p = tray.look.of<Refraction>();
    p.rejection = Refraction::Rejection::kShorten;
    p.off_frame = Refraction::OffFrame::kFog;
    p.strength = 0.07 / 0.6;
    // From 18.5 / 20 to 0.995; the last texels are at 0.975.
    const test::Picture got = tray.wet();
    EXPECT_NEAR(got.aov(Aov::kTransmitted, down ? 9 : 18, down ? 18 : 9, 1), 0.5 * 0.6, 1e-5);
    EXPECT_NEAR(got.aov(Aov::kTransmitted, 9, 9, 1), 0.5, 1e-6);
  }
}

/// A shore on which no water is drawn: the layer below and the rays continue under the shore.
TEST(Shorten, ALayerBelowIsSeenUnderTheShoreToo) {
  Tray tray(kSize);
  constexpr int kShore = 30;
  constexpr float kBottom = 40;
  const auto shore = [](int x) { return x >= kShore; };
  tray.buffers.set(PlaneId::kDepth, [=](int x, int) { return shore(x) ? 9.f : kBottom; });
  tray.buffers.set(PlaneId::kSurfaceDepth,
                   [=](int x, int) { return shore(x) ? test::kInf : 10.f; });
  tray.buffers.fill(PlaneId::kBelowDepth, kBottom);
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kBelowR, c), [](int x, int) { return 0.01f * float(x); });
  }
  const double lean = 0.5, upright = std::sqrt(1 - lean * lean);
  tray.buffers.normal({-lean, upright, 0});
  tray.look.of<PrismSplit>().strength = 0;
  Refraction::Params& p = tray.look.of<Refraction>();
  p.model = Refraction::Model::kSnell;
  p.steps = Refraction::kMarch;
  p.rejection = Refraction::Rejection::kShorten;
  p.off_frame = Refraction::OffFrame::kShorten;

  const double turned = std::asin(lean) - std::asin(lean / tray.look.water.ior);
  const double shift = (kBottom - 10) * std::tan(turned);
  const int x = kShore - 1, y = 20;
  ASSERT_GT(x + shift, kShore + 2);
  for (const test::Picture& got :
       {tray.wet(), test::fused(tray.look, tray.buffers.frame, tray.scene)}) {
    EXPECT_EQ(got.aov(Aov::kConfidence, x, y), 1);
    EXPECT_NEAR(got.aov(Aov::kStmapG, x, y, 0) * kSize.width, x + 0.5 + shift, 0.05);
    EXPECT_NEAR(got.aov(Aov::kTransmitted, x, y), 0.01 * (x + shift), 1e-3);
  }
}

}  // namespace
}  // namespace limpid

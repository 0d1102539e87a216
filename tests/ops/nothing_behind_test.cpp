#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ops/tray.h"

// Nothing behind the water: where the dry picture has hit nothing, its color (a sky) is never seen
// through the surface, by any model of refraction.

namespace limpid {
namespace {

constexpr Size kSize{40, 30};
constexpr float kSky = 100;
constexpr double kBottomColor = 0.5;

using R = Refraction;

/// All models of refraction, with and without a prism, each with a name.
template <class Fn>
void each_refraction(Fn&& fn) {
  const auto fog_models = {DepthFog::Model::kLinear, DepthFog::Model::kBeerLambert};
  for (const R::Model model : {R::Model::kNormalOffset, R::Model::kDudvOffset, R::Model::kSnell}) {
    for (const int steps : {0, 2, R::kMarch}) {
      if (model != R::Model::kSnell && steps != 0) continue;
      for (const R::Rejection rejection :
           {R::Rejection::kNone, R::Rejection::kSnap, R::Rejection::kShorten}) {
        for (const R::OffFrame off : {R::OffFrame::kClamp, R::OffFrame::kShorten, R::OffFrame::kFog,
                                      R::OffFrame::kContinue}) {
          for (const DepthFog::Model fog : fog_models) {
            for (const bool prism : {false, true}) {
              Look look = test::still_look();
              look.of<R>() = {model, 0.05, rejection, steps, off};
              look.of<PrismSplit>() = {PrismSplit::Model::kDispersion, 0, prism ? 20.0 : 0.0};
              look.of<DepthFog>() = test::plain_fog(fog);
              look.of<DepthFog>().distance = DepthFog::Distance::kRefracted;
              look.of<DepthFog>().scattering = {0.1, 0.2, 0.3};
              look.of<DepthFog>().ambient = {1, 1, 1};
              fn(look, "model " + std::to_string(int(model)) + ", steps " + std::to_string(steps) +
                           ", rejection " + std::to_string(int(rejection)) + ", off frame " +
                           std::to_string(int(off)) + ", fog " + std::to_string(int(fog)) +
                           (prism ? ", prism" : ""));
            }
          }
        }
      }
    }
  }
}

/// Water 2 below the camera with waves; the bottom 1 below the water where `has_bottom`, else a sky
/// without depth; an object stands before the water at a few pixels.
struct Sea {
  template <class HasBottom>
  explicit Sea(HasBottom&& has_bottom, bool below = false, bool foreground = true)
      : buffers(rect_of(kSize)), scene(test::simple_scene(kSize)) {
    const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
    const auto bottom = [&, rays](int x, int y) {
      const double z = -3 / rays.ray_at(x + 0.5, y + 0.5).y;
      return z > 0 && has_bottom(x, y) ? static_cast<float>(z) : test::kInf;
    };
    const auto post = [=](int x, int y) { return foreground && x >= 10 && x < 13 && y < 22; };
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
        return std::isinf(bottom(x, y)) && !post(x, y) ? kSky : float(kBottomColor);
      });
      if (!below) continue;
      buffers.set(plane_after(PlaneId::kBelowR, c), [&](int x, int y) {
        return std::isinf(bottom(x, y)) ? kSky : float(kBottomColor);
      });
    }
    buffers.set(PlaneId::kDepth, [&](int x, int y) { return post(x, y) ? 1.0f : bottom(x, y); });
    if (below) buffers.set(PlaneId::kBelowDepth, bottom);
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kSurfaceNormalX, c), [&](int x, int y) {
        const double sx = 0.3 * test::noise(x, y, 1) - 0.15, sz = 0.3 * test::noise(x, y, 2) - 0.15;
        const double n[3] = {sx, 1, sz};
        return static_cast<float>(n[c] / std::sqrt(sx * sx + 1 + sz * sz));
      });
    }
  }
  test::Picture wet(const Look& look) const { return test::reference(look, buffers.frame, scene); }

  test::Buffers buffers;
  Scene scene;
};

bool in_open_sea(int x, int y) { return x + y / 2 < 25; }

TEST(NothingBehind, OpenSeaIsFullFogByAGuess) {
  const Sea sea([](int, int) { return false; }, false, false);
  each_refraction([&](const Look& look, const std::string& name) {
    const test::Picture got = sea.wet(look);
    const DepthFog::Params& fog = look.of<DepthFog>();
    each_wet(got, kSize, [&](int x, int y) {
      SCOPED_TRACE(name + " at " + std::to_string(x) + ", " + std::to_string(y));
      ASSERT_EQ(got.aov(Aov::kTransmitted, x, y), 0);
      ASSERT_TRUE(std::isinf(got.aov(Aov::kPath, x, y)));
      ASSERT_EQ(got.aov(Aov::kConfidence, x, y), 0);
      if (fog.model != DepthFog::Model::kLinear) return;
      // The article's fog at its thickest: its alpha of the water's color.
      ASSERT_NEAR(got.aov(Aov::kInScatter, x, y), fog.alpha * fog.color.r, 1e-6);
    });
  });
}

TEST(NothingBehind, TheSkyNeverBleedsIn) {
  for (const bool below : {false, true}) {
    const Sea sea(in_open_sea, below);
    each_refraction([&](const Look& look, const std::string& name) {
      const test::Picture got = sea.wet(look);
      int none = 0, seen = 0;
      each_wet(got, kSize, [&](int x, int y) {
        SCOPED_TRACE(name + (below ? ", below at " : " at ") + std::to_string(x) + ", " +
                     std::to_string(y));
        for (int c = 0; c < 3; ++c) {
          const double light = got.aov(Aov::kTransmitted, x, y, c);
          ASSERT_GE(light, 0);
          ASSERT_LE(light, kBottomColor * got.aov(Aov::kTransmittance, x, y, c) + 1e-6);
        }
        const bool endless = std::isinf(got.aov(Aov::kPath, x, y));
        if (endless) {
          ASSERT_EQ(got.aov(Aov::kConfidence, x, y), 0);
        }
        none += endless;
        seen += got.aov(Aov::kConfidence, x, y) > 0.9;
      });
      EXPECT_GT(none, 50) << name;
      EXPECT_GT(seen, 50) << name;
    });
  }
}

TEST(NothingBehind, ABottomIsNotDarkerBesideIt) {
  const Sea sea(in_open_sea);
  each_refraction([&](const Look& look, const std::string& name) {
    Look clear = look;
    clear.of<DepthFog>().alpha = 0;
    clear.of<DepthFog>().model = DepthFog::Model::kLinear;
    if (clear.of<PrismSplit>().gain > 0) return;  // the colors part there
    const test::Picture got = sea.wet(clear);
    each_wet(got, kSize, [&](int x, int y) {
      const double light = got.aov(Aov::kTransmitted, x, y);
      if (look.of<R>().off_frame == R::OffFrame::kFog) return;
      ASSERT_TRUE(light == 0 || std::abs(light - kBottomColor) < 1e-5)
          << name << " at " << x << ", " << y << ": " << light;
    });
  });
}

/// Without refraction and without fog there is still no sky under water.
TEST(NothingBehind, ALookThatDoesNothingShowsNoSky) {
  const Sea sea(in_open_sea);
  Look look = test::still_look();
  look.of<WaveNormals>().strength = 0;
  look.of<FresnelReflection>().source = FresnelReflection::Source::kConstant;
  look.of<FresnelReflection>().f0 = 0;
  look.of<FresnelReflection>().reflectance = FresnelReflection::Reflectance::kSchlick;
  const test::Picture got = sea.wet(look);
  each_wet(got, kSize, [&](int x, int y) {
    ASSERT_LE(got.color(x, y).r, kBottomColor + 1e-6) << x << ", " << y;
  });
}

TEST(NothingBehind, PenetrationLetsNothingThrough) {
  const Sea sea([](int, int) { return false; });
  Look look = test::still_look();
  look.of<Penetration>() = {Penetration::Model::kViewAngle, 0.5, 0.5, 1};
  const test::Picture got = sea.wet(look);
  each_wet(got, kSize, [&](int x, int y) { ASSERT_EQ(got.color(x, y).r, 0) << x << ", " << y; });
}

/// The sky over the water is seen from below, and looks that do not march are confident of this
/// sky.
TEST(NothingBehind, FromBelowTheSkyIsSeen) {
  test::Buffers buffers(rect_of(kSize));
  Scene scene = test::simple_scene(kSize);
  scene.camera->view =
      glm::lookAt(glm::dvec3(0, -2, 0), glm::dvec3(0, 0, -0.5), glm::dvec3(0, 1, 0));
  for (int c = 0; c < 3; ++c) buffers.fill(plane_after(PlaneId::kColorR, c), kSky);
  buffers.fill(PlaneId::kDepth, test::kInf);
  each_refraction([&](const Look& look, const std::string& name) {
    const test::Picture got = test::reference(look, buffers.frame, scene);
    const int x = kSize.width / 2, y = kSize.height / 2;
    EXPECT_GT(got.aov(Aov::kTransmitted, x, y), 1) << name;
  });
}

}  // namespace
}  // namespace limpid

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "limpid/files/text/look_file.h"

#include "optics/fresnel.h"
#include "optics/highlight.h"
#include "paths.h"
#include "support.h"

// The energy of the light that the water returns, by the whole chain in both runners.

namespace limpid {
namespace {

using test::Buffers;
using test::Picture;

constexpr Size kSize{61, 37};

using Runner = Picture (*)(const Look&, const Frame&, const Scene&);
Picture run_fast(const Look& look, const Frame& frame, const Scene& scene) {
  return test::fused(look, frame, scene);
}

class Energy : public testing::TestWithParam<Runner> {
 protected:
  static Picture run(const Look& look, const Buffers& b, const Scene& scene) {
    return GetParam()(look, b.frame, scene);
  }
};

INSTANTIATE_TEST_SUITE_P(Runners, Energy, testing::Values(&test::reference, &run_fast),
                         [](const auto& p) { return p.index == 0 ? "Reference" : "Fused"; });

template <class Fn>
void for_each_wet(const Picture& p, Fn&& fn) {
  int wet = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      if (std::isinf(p.aov(Aov::kSurfaceDepth, x, y))) continue;
      ++wet;
      fn(x, y);
    }
  }
  EXPECT_GT(wet, 500);
}

/// A noisy frame in which every surface is white.
Buffers white_frame() {
  Buffers b = test::noisy_frame(rect_of(kSize));
  for (PlaneId first : {PlaneId::kColorR, PlaneId::kReflectionR, PlaneId::kBelowR}) {
    for (int c = 0; c < 3; ++c) b.fill(plane_after(first, c), 1);
  }
  return b;
}

void remove(PlaneSet planes, Buffers& b) {
  for (int i = 0; i < kPlaneCount; ++i) {
    if (planes.has(static_cast<PlaneId>(i))) b.frame.planes[i] = {};
  }
}

/// A 1x1 map of the surroundings, white.
class WhiteSky {
 public:
  WhiteSky() : plane_(Rect{0, 0, 1, 1}) {
    plane_.view().at(0, 0) = 1;
    texture.channels.fill(plane_.view());
  }
  Texture texture;

 private:
  Plane plane_;
};

/// The physical look over water that neither absorbs nor emits.
Look clear_look() {
  Look look;
  look.of<DepthFog>() = test::plain_fog(DepthFog::Model::kBeerLambert);
  look.of<DepthFog>().distance = DepthFog::Distance::kRefracted;
  look.of<DepthFog>().absorption = {0, 0, 0};
  look.of<DepthFog>().sunlight = DepthFog::Sunlight::kNone;
  return look;
}

Scene sunless_scene() {
  Scene scene = test::simple_scene(kSize);
  scene.sun.reset();
  return scene;
}

void expect_white(const Picture& p) {
  for_each_wet(p, [&](int x, int y) {
    // For at least one color no surface is hit, and no light comes from there.
    if (std::isinf(p.aov(Aov::kPath, x, y)) || p.aov(Aov::kConfidence, x, y) < 0.85) return;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(p.target.color[c].at(x, y), 1, 1e-5) << x << ", " << y << ", channel " << c;
    }
  });
}

TEST_P(Energy, ClearWaterInAWhiteWorldIsWhite) {
  const WhiteSky sky;
  for (const auto rejection : {Refraction::Rejection::kNone, Refraction::Rejection::kSnap,
                               Refraction::Rejection::kShorten}) {
    Look look = clear_look();
    look.of<Refraction>().rejection = rejection;
    Buffers b = white_frame();
    b.frame.environment = sky.texture;  // where the reflection is not valid
    expect_white(run(look, b, sunless_scene()));
    remove(kBelowPlanes, b);
    expect_white(run(look, b, sunless_scene()));
    remove(PlaneSet{PlaneId::kReflectionValid}, b);
    b.frame.environment = {};
    expect_white(run(look, b, sunless_scene()));
    remove(PlaneSet{PlaneId::kReflectionDepth}, b);
    expect_white(run(look, b, sunless_scene()));
    b.frame.environment = sky.texture;
    look.of<FresnelReflection>().source = FresnelReflection::Source::kEnvironment;
    expect_white(run(look, b, sunless_scene()));
  }
}

TEST_P(Energy, WhatAbsorptionTakesIsAllThatIsMissing) {
  const WhiteSky sky;
  Buffers b = white_frame();
  remove(kBelowPlanes, b);
  b.frame.environment = sky.texture;
  Look look = clear_look();
  const Rgb<double> rate{0.4, 0.1, 0.02};
  look.of<DepthFog>().absorption = rate;
  const Picture p = run(look, b, sunless_scene());
  for_each_wet(p, [&](int x, int y) {
    const double f = p.aov(Aov::kFresnel, x, y), path = p.aov(Aov::kPath, x, y);
    for (int c = 0; c < 3; ++c) {
      const double survives = std::exp(-(c == 0 ? rate.r : c == 1 ? rate.g : rate.b) * path);
      EXPECT_NEAR(p.aov(Aov::kTransmittance, x, y, c), survives, 1e-5);
      EXPECT_NEAR(p.aov(Aov::kTransmitted, x, y, c), (1 - f) * survives, 1e-5);
      EXPECT_NEAR(p.aov(Aov::kReflected, x, y, c), f, 1e-5);
      EXPECT_EQ(p.aov(Aov::kInScatter, x, y, c), 0);
      EXPECT_NEAR(p.target.color[c].at(x, y), 1 - (1 - f) * (1 - survives), 1e-5);
    }
  });
}

TEST_P(Energy, TheFourTermsOfEveryLookSumToThePicture) {
  const test::NoiseMap sky(16, 8);
  Buffers b = test::noisy_frame(rect_of(kSize));
  b.frame.environment = sky.texture;
  for (const std::string name : {"fast", "monogame", "physical", "realistic", "rito"}) {
    Look look = load_look(std::string(LIMPID_DATA) + "/looks/" + name + ".toml");
    look.of<SunHighlight>().roughness = 0.1;  // so that some of few pixels glint
    const Picture p = run(look, b, test::simple_scene(kSize));
    double reflected = 0, lit = 0;
    for_each_wet(p, [&](int x, int y) {
      for (int c = 0; c < 3; ++c) {
        const double mirrored = p.aov(Aov::kReflected, x, y, c);
        const double glint = p.aov(Aov::kHighlight, x, y, c);
        const double sum =
            p.aov(Aov::kTransmitted, x, y, c) + p.aov(Aov::kInScatter, x, y, c) + mirrored + glint;
        // Every term and the sum is rounded to float once; so may the partial sums be.
        EXPECT_NEAR(p.target.color[c].at(x, y), sum, 3e-7 * sum) << name;
        reflected += mirrored;
        lit += glint;
      }
    });
    EXPECT_GT(reflected, 0) << name;
    EXPECT_GT(lit, 0) << name;
  }
}

template <class Fn>
void set_normals(Buffers& b, Fn&& normal) {
  for (int c = 0; c < 3; ++c) {
    b.set(plane_after(PlaneId::kSurfaceNormalX, c),
          [&](int x, int y) { return static_cast<float>(normal(x, y)[c]); });
  }
}

/// Water everywhere, wavy; the normal of every third pixel mirrors the sun to the eye.
struct Glints {
  Glints() : b(test::noisy_frame(rect_of(kSize))), scene(test::simple_scene(kSize)) {
    b.fill(PlaneId::kSurfaceDepth, 3).fill(PlaneId::kDepth, 5);
    b.set(PlaneId::kSurfaceShadow, [](int x, int y) { return float(lit(x, y)); });
    set_normals(b, [&](int x, int y) {
      if ((x + y) % 3 == 0) return half_vector(x, y);
      return glm::normalize(
          glm::dvec3(test::noise(x, y, 70) - 0.5, 2, test::noise(x, y, 71) - 0.5));
    });
  }
  static bool lit(int x, int y) { return (x / 2 + y) % 2 == 0; }
  glm::dvec3 to_viewer(int x, int y) const {
    return -glm::normalize(
        rays_of(*scene.camera, {kSize.width, kSize.height}).ray_at(x + 0.5, y + 0.5));
  }
  glm::dvec3 half_vector(int x, int y) const {
    return glm::normalize(to_viewer(x, y) + glm::normalize(scene.sun->direction));
  }
  Buffers b;
  Scene scene;
};

TEST_P(Energy, AGlintIsNoBrighterThanTheMirroredSun) {
  const Glints glints;
  const Rgb<double> sun = glints.scene.sun->color;
  for (double roughness : {0.0, 0.001, 0.01, 0.3, 1.0}) {
    Look look;
    look.of<SunHighlight>().roughness = roughness;
    const Picture p = run(look, glints.b, glints.scene);
    double brightest = 0;
    for_each_wet(p, [&](int x, int y) {
      const double cosine = glm::dot(glints.to_viewer(x, y), glints.half_vector(x, y));
      const double disc = fresnel_exact(cosine, 1.333) * std::numbers::pi / kSunSolidAngle;
      const double share = p.aov(Aov::kHighlight, x, y, 0) / (disc * sun.r);
      EXPECT_GE(share, 0);
      EXPECT_LE(share, 1 + 1e-4);
      EXPECT_NEAR(p.aov(Aov::kHighlight, x, y, 1) * sun.r, p.aov(Aov::kHighlight, x, y, 0) * sun.g,
                  1e-5 * disc);
      brightest = std::max(brightest, share);
    });
    // Rough water spreads the light so far that the bound is not met.
    EXPECT_GT(brightest, roughness < 0.01 ? 0.99 : 0) << roughness;
  }
}

TEST_P(Energy, NothingGlintsInTheShadow) {
  const Glints glints;
  using Model = SunHighlight::Model;
  for (const Model model : {Model::kPhong, Model::kBlinnPhong, Model::kGgx}) {
    for (double roughness : {0.0, 0.1}) {
      Look look;
      look.of<SunHighlight>().model = model;
      look.of<SunHighlight>().roughness = roughness;
      look.of<SunHighlight>().power = 4;
      const Picture p = run(look, glints.b, glints.scene);
      int shines = 0;
      for_each_wet(p, [&](int x, int y) {
        const double glint = p.aov(Aov::kHighlight, x, y, 0);
        if (!Glints::lit(x, y)) {
          EXPECT_EQ(glint, 0);
        }
        shines += glint > 0;
      });
      EXPECT_GT(shines, 100);
    }
  }
}

TEST_P(Energy, ReflectanceIsAShare) {
  Buffers b = test::noisy_frame(rect_of(kSize));
  // Any direction, facets that face away included.
  set_normals(b, [](int x, int y) {
    const auto part = [&](int channel) { return test::noise(x, y, channel) - 0.5; };
    return glm::normalize(glm::dvec3(part(70), part(71), part(72)));
  });
  using Reflectance = FresnelReflection::Reflectance;
  for (const Reflectance model :
       {Reflectance::kRim, Reflectance::kLinear, Reflectance::kInversePower, Reflectance::kSchlick,
        Reflectance::kExact}) {
    Look look;
    look.of<FresnelReflection>().reflectance = model;
    look.of<FresnelReflection>().intensity = 3;
    const Picture p = run(look, b, test::simple_scene(kSize));
    for_each_wet(p, [&](int x, int y) {
      EXPECT_GE(p.aov(Aov::kFresnel, x, y), 0);
      EXPECT_LE(p.aov(Aov::kFresnel, x, y), 1);
    });
  }
}

}  // namespace
}  // namespace limpid

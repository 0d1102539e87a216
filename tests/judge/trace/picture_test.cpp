#include <cstring>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/raster/render_plate.h"

#include "judge/trace/trace_scenes.h"
#include "optics/waves.h"

/// Samples, threads, dry pixels, waves, and refused scenes.

namespace limpid::test {
namespace {

bool same_bits(const TruthPicture& p, const TruthPicture& q) {
  if (p.planes.size() != q.planes.size()) return false;
  bool same = true;
  for (std::size_t i = 0; i < p.planes.size(); ++i) {
    for_each_pixel(p.window.size(), [&](int x, int y) {
      const float a = p.planes[i].view().at(x, y), b = q.planes[i].view().at(x, y);
      same = same && std::memcmp(&a, &b, sizeof a) == 0;
    });
  }
  return same;
}

/// A floor and a wavy surface, both of many triangles; the floor has two copies.
Model wavy_pool() {
  Mesh water = hills(20, 12, 0);
  water.uvs.clear();
  Mesh floor = level(-1, 6);
  Model model = model_of({floor, floor, water, hills(10, 6, 0.4)}, lambert({0.7, 0.6, 0.5}));
  model.instances[2].water = true;
  model.instances[3].world_from_mesh = glm::translate(glm::dmat4(1), glm::dvec3(0, -0.2, -1));
  return model;
}

Scene wavy_scene() {
  Scene scene = over_water(35);
  scene.water->waves = {{0.05, 2, 1, 0.3, 3}, {0.02, -4, 3, 1.1, 5}};
  scene.time = 0.7;
  return scene;
}

TEST(TracedPicture, HasTheSameBitsWhateverTheThreadsAndForEachSeedItsOwn) {
  const Model model = wavy_pool();
  TruthOptions options = every_aov();
  options.samples = 2;
  const Look look;
  const TruthPicture one = traced(model, wavy_scene(), look, options, 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(same_bits(one, traced(model, wavy_scene(), look, options, 2)));
  }
  options.seed = 1;
  EXPECT_FALSE(same_bits(one, traced(model, wavy_scene(), look, options, 2)));
}

TEST(TracedPicture, WavesAreThoseOfTheSceneOnAMeshOfTwoTriangles) {
  Model model = model_of({level(-1, 6), level(0, 40)}, lambert({0.7, 0.6, 0.5}));
  model.instances[1].water = true;
  const Scene scene = wavy_scene();
  const TruthPicture p = traced(model, scene, Look{}, every_aov());
  const Rays rays = rays_of(*scene.camera, {kTraceSize.width, kTraceSize.height});
  int wet = 0;
  for_each_pixel(kTraceSize, [&](int x, int y) {
    const double depth = value(p, Aov::kSurfaceDepth, x, y, 0);
    if (!std::isfinite(depth)) return;
    ++wet;
    const glm::dvec3 at = scene.camera->eye() + depth * rays.ray_at(x + 0.5, y + 0.5);
    const PlaneAxes axes = plane_axes(scene.water->up);
    const WaveHeight wave =
        wave_height(scene.water->waves, glm::dot(at, axes.x), glm::dot(at, axes.y), scene.time);
    EXPECT_NEAR(at.y, wave.height, 0.003);  // a tenth of what edges of a quarter wave would miss
    const glm::dvec3 normal =
        glm::normalize(scene.water->up - wave.slope_x * axes.x - wave.slope_y * axes.y);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value(p, Aov::kNormal, x, y, c), normal[c], 1e-4);
  });
  EXPECT_GT(wet, 100);
}

TEST(TracedPicture, TermsSumToThePicture) {
  TruthOptions options = every_aov();
  options.samples = 2;
  const TruthPicture p = traced(wavy_pool(), wavy_scene(), Look{}, options);
  for_each_pixel(kTraceSize, [&](int x, int y) {
    for (int c = 0; c < 3; ++c) {
      const double sum = value(p, Aov::kTransmitted, x, y, c) + value(p, Aov::kInScatter, x, y, c) +
                         value(p, Aov::kReflected, x, y, c) + value(p, Aov::kHighlight, x, y, c);
      const double color = p.target.color[static_cast<std::size_t>(c)].at(x, y);
      EXPECT_NEAR(sum, color, 1e-6 * (1 + color));
      EXPECT_TRUE(std::isfinite(color) && color >= 0);
    }
    EXPECT_EQ(p.target.alpha.at(x, y), 1);
  });
}

/// The variance of the share of a pixel that a straight edge covers: only the strata that the edge
/// crosses have an error, about n of n^2, each at most 1 / n^2: the variance falls as 1 / n^3.
TEST(TracedPicture, SamplesConvergeAsStrataDo) {
  constexpr Size kSize{24, 24};
  const Scene scene = [&] {
    Scene s = over_water(0, kSize);
    s.water->height = -50;
    return s;
  }();
  // White to the right of a slanting edge that crosses the whole picture.
  Model model = model_of({quad({0.3f, -20, -5}, {30, -20, -5}, {30, 24, -5}, {1.3f, 24, -5})});
  model.background = {0, 0, 0};
  const auto share = [&](int samples, std::uint64_t seed) {
    TruthOptions options;
    options.size = kSize;
    options.samples = samples;
    options.seed = seed;
    return traced(model, scene, calm_look(), options);
  };
  const TruthPicture truth = share(16, 99);
  const auto variance = [&](int samples) {
    double sum = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const TruthPicture p = share(samples, seed);
      for_each_pixel(kSize, [&](int x, int y) {
        const double off = p.target.color[0].at(x, y) - truth.target.color[0].at(x, y);
        sum += off * off;
      });
    }
    return sum;
  };
  const double at_2 = variance(2), at_6 = variance(6);
  EXPECT_GT(at_2 / at_6, 27 / 2.5);
  EXPECT_LT(at_2 / at_6, 27 * 2.5);
}

/// All materials, textures in their mip levels, faces without normals, back faces.
TEST(TracedPicture, DryPixelsAreTheRasterisers) {
  Model model = mixed_model();
  constexpr Size kSize{96, 72};
  Scene scene;
  scene.camera = mixed_view(kSize.width, kSize.height).camera;
  scene.water = WaterPlane{{0, 1, 0}, -60};
  scene.sun = low_sun().sun;
  auto executor = make_executor(1);
  const RenderedPlate plate =
      render_plate(model, scene, {.size = kSize},
                   kColorPlanes | PlaneSet{PlaneId::kDepth, PlaneId::kShadow}, *executor);
  TruthOptions options;
  options.size = kSize;
  const TruthPicture p = traced(model, scene, calm_look(), options);
  int near = 0, all = 0, lit = 0;
  for_each_pixel(kSize, [&](int x, int y) {
    if (std::isinf(plate.frame.plane(PlaneId::kDepth).at(x, y))) return;
    // The raster pass has soft shadow edges and a depth bias.
    const float shadow = plate.frame.plane(PlaneId::kShadow).at(x, y);
    if (shadow != 0 && shadow != 1) return;
    double off = 0;
    for (int c = 0; c < 3; ++c) {
      const double dry = plate.frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
      off = std::max(off, std::abs(p.target.color[static_cast<std::size_t>(c)].at(x, y) - dry));
    }
    near += off < 2e-3;
    lit += shadow == 1;
    ++all;
  });
  EXPECT_GT(all, 3000);
  EXPECT_GT(lit, 1000);
  EXPECT_GT(near, 0.98 * all);
}

TEST(TracedPicture, MeetsTheRaisedSurfaceWhereTheRasteriserDrawsIt) {
  const Model model = wavy_pool();
  const Scene scene = wavy_scene();
  auto executor = make_executor(1);
  const RenderedPlate plate = render_plate(
      model, scene, {.size = kTraceSize},
      kSurfaceNormalPlanes | PlaneSet{PlaneId::kSurfaceDepth, PlaneId::kDepth}, *executor);
  const TruthPicture p = traced(model, scene, calm_look());
  int wet = 0;
  for_each_pixel(kTraceSize, [&](int x, int y) {
    const double drawn = plate.frame.plane(PlaneId::kSurfaceDepth).at(x, y);
    const double dry = plate.frame.plane(PlaneId::kDepth).at(x, y);
    if (!(drawn < dry - 1e-3)) return;
    ++wet;
    EXPECT_NEAR(value(p, Aov::kSurfaceDepth, x, y), drawn, 1e-3 * drawn);
    for (int c = 0; c < 3; ++c) {
      const double normal = plate.frame.plane(plane_after(PlaneId::kSurfaceNormalX, c)).at(x, y);
      EXPECT_NEAR(value(p, Aov::kNormal, x, y, c), normal, 5e-3);
    }
  });
  EXPECT_GT(wet, 300);
}

/// A bar over the water hides a strip of the floor from the dry camera; refracted rays that pass
/// the bar still meet that floor.
TEST(TracedPicture, WhatABarHidesIsNotVisible) {
  constexpr float kZ = -3, kLow = 0.3f, kHigh = 0.5f;
  const Mesh bar = quad({-9, kLow, kZ}, {9, kLow, kZ}, {9, kHigh, kZ}, {-9, kHigh, kZ});
  const Model model = model_of({level(-1), bar});
  const Scene scene = over_water(30);
  const TruthPicture p = traced(model, scene, calm_look());
  int hidden = 0, seen = 0;
  for_each_pixel(kTraceSize, [&](int x, int y) {
    const glm::dvec3 eye = scene.camera->eye(), d = view_through(scene, x, y);
    if (d.y > -0.05 || std::isinf(value(p, Aov::kSurfaceDepth, x, y))) return;
    const double inside = std::sqrt(1 - (1 - d.y * d.y) / (kTraceIor * kTraceIor));
    const glm::dvec3 end =
        eye - (eye.y / d.y) * d + glm::dvec3(d.x, -kTraceIor * inside, d.z) / (kTraceIor * inside);
    const glm::dvec2 at = place_of(scene, end);
    if (at.x < 0 || at.x > 1 || at.y < 0 || at.y > 1) return;
    const double s = (kZ - eye.z) / (end.z - eye.z), passes = eye.y + s * (end.y - eye.y);
    if (std::abs(passes - kLow) < 1e-3 || std::abs(passes - kHigh) < 1e-3) return;
    const bool hides = s < 1 && passes > kLow && passes < kHigh;
    EXPECT_EQ(p.visible[1].at(x, y), !hides) << x << ", " << y;
    EXPECT_EQ(p.visible_below[1].at(x, y), 1) << "the bar is cut away with all that is in the air";
    (hides ? hidden : seen) += 1;
  });
  EXPECT_GT(hidden, 30);
  EXPECT_GT(seen, 200);
}

/// Meshes without triangles, and triangles without area, change nothing, also in front of other
/// meshes.
TEST(TracedPicture, TakesNoNoticeOfEmptyWater) {
  const Model model = wavy_pool();
  const TruthPicture right = traced(model, wavy_scene(), Look{});
  Mesh flat = hills(2, 1, 0), none = hills(2, 1, 0);
  std::fill(flat.indices.begin(), flat.indices.end(), 0u);
  none.indices.clear();
  Model more = model;
  for (const Mesh& mesh : {flat, none}) {
    more.meshes.push_back(mesh);
    Instance empty = more.instances[2];
    empty.mesh = static_cast<int>(more.meshes.size()) - 1;
    more.instances.insert(more.instances.begin(), empty);
  }
  EXPECT_TRUE(same_bits(right, traced(more, wavy_scene(), Look{})));
}

/// The calm normal, as in the chain.
TEST(TracedPicture, ViewsInTheWaterThatMeetNoSurfaceHaveItsNormal) {
  Scene scene = over_water(20);
  scene.water->height = 3;
  const TruthPicture p = traced(model_of({level(-1)}), scene, calm_look());
  int down = 0;
  for_each_pixel(kTraceSize, [&](int x, int y) {
    if (!std::isinf(value(p, Aov::kSurfaceDepth, x, y))) return;
    ++down;
    EXPECT_EQ(value(p, Aov::kNormal, x, y, 0), 0);
    EXPECT_EQ(value(p, Aov::kNormal, x, y, 1), 1);
    EXPECT_EQ(value(p, Aov::kNormal, x, y, 2), 0);
  });
  EXPECT_GT(down, 300);
}

/// The message of the Error after a change to a valid scene.
template <class Change>
std::string refusal(Change&& change) {
  Scene scene = over_water(40);
  TruthOptions options = every_aov();
  change(scene, options);
  try {
    traced(model_of({level(-1)}), scene, calm_look(), options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(TracedPicture, RefusesWhatItCannotTrace) {
  using testing::HasSubstr;
  EXPECT_EQ(refusal([](Scene&, TruthOptions&) {}), "");
  EXPECT_THAT(refusal([](Scene&, TruthOptions& o) { o.samples = 17; }),
              HasSubstr("samples = 17: expected 1 ... 16"));
  EXPECT_THAT(refusal([](Scene&, TruthOptions& o) { o.size = {0, 5}; }), HasSubstr("size 0x5"));
  EXPECT_THAT(refusal([](Scene&, TruthOptions& o) {
                o.size = {32000, 32000};
              }),
              HasSubstr("1024000000 pixels with overscan and samples: expected at most 134217728"));
  EXPECT_THAT(refusal([](Scene&, TruthOptions& o) { o.aovs.push_back(Aov::kPath); }),
              HasSubstr("'path' is named twice"));
  EXPECT_THAT(refusal([](Scene&, TruthOptions& o) { o.aovs.push_back(Aov::kConfidence); }),
              HasSubstr("visible"));
  EXPECT_THAT(refusal([](Scene& s, TruthOptions&) {
                s.sun->direction = {0, -1, 0};
              }),
              HasSubstr("below the horizon"));
  EXPECT_THAT(refusal([](Scene& s, TruthOptions&) { s.camera.reset(); }), HasSubstr("no camera"));
  EXPECT_THAT(refusal([](Scene& s, TruthOptions&) { s.water.reset(); }), HasSubstr("no water"));
  EXPECT_THAT(refusal([](Scene& s, TruthOptions&) {
                s.water->waves.push_back({0.1, 1, 0, 0, 1});
              }),
              HasSubstr("waves"));
  EXPECT_THAT(refusal([](Scene& s, TruthOptions&) {
                s.camera->projection = orthographic(2, 2, 0, 10, ClipSpace::kGl);
                s.water->height = 5;
              }),
              HasSubstr("orthographic"));
}

}  // namespace
}  // namespace limpid::test

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "limpid/files/text/look_file.h"

#include "ops/depth_fog_kernel.h"
#include "paths.h"
#include "support.h"

// The bundled presets. Tests of the base look check the laws of all looks; these tests check the
// effects of the presets' numbers.

namespace limpid {
namespace {

namespace fs = std::filesystem;

const fs::path kData(LIMPID_DATA);
constexpr const char* kPresets[] = {"basin",    "creek",        "harbour",
                                    "open_sea", "lake_at_dusk", "pool"};

Look preset(const std::string& name) { return load_look(kData / "presets" / (name + ".toml")); }

std::vector<std::string> differences(const Look& a, const Look& b) {
  std::vector<std::string> names;
  const std::vector<Parameter> of_a = parameters(a), of_b = parameters(b);
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (of_a[i].value == of_b[i].value) continue;
    names.push_back(std::string(of_a[i].table) + "." + std::string(of_a[i].name));
  }
  return names;
}

TEST(Presets, AreTheFilesOfTheFolderAndNamesOfNoLook) {
  const fs::path looks[] = {kData / "looks"}, presets[] = {kData / "presets"};
  std::vector<std::string> known(std::begin(kPresets), std::end(kPresets));
  std::sort(known.begin(), known.end());
  EXPECT_EQ(look_names(presets), known);
  for (const std::string& look : look_names(looks)) {
    EXPECT_EQ(std::count(known.begin(), known.end(), look), 0) << look;
  }
}

/// Water, size and wind are the preset's own; the computation is the base's.
TEST(Presets, AreThePhysicsOfOneWater) {
  const Look physical = load_look(kData / "looks/physical.toml");
  const std::string own[] = {
      "wave_normals.strength", "wave_normals.tile_size", "wave_normals.direction",
      "wave_normals.wind",     "depth_fog.murkiness",    "depth_fog.water_type",
      "depth_fog.sediment",    "depth_fog.cdom",         "depth_fog.anisotropy"};
  for (const char* name : kPresets) {
    const Look look = preset(name);
    EXPECT_EQ(look.name, name);
    ASSERT_EQ(look.bases.size(), 1u) << name;
    EXPECT_TRUE(fs::equivalent(look.bases[0], physical.file)) << name;
    EXPECT_FALSE(look.about.empty()) << name;
    EXPECT_EQ(unread_settings(look), std::vector<std::string>{}) << name;
    const std::vector<std::string> found = differences(look, physical);
    for (const std::string& key : found) {
      EXPECT_NE(std::find(std::begin(own), std::end(own), key), std::end(own))
          << name << ", " << key;
    }
    for (const char* key : {"wave_normals.tile_size", "wave_normals.wind", "depth_fog.murkiness"}) {
      EXPECT_NE(std::find(found.begin(), found.end(), key), found.end()) << name << ", " << key;
    }
    // The sliders of murkiness, wind and sediment begin at the preset's values.
    EXPECT_EQ(look.of<DepthFog>().water_type, WaterType::kCase1) << name;
    EXPECT_EQ(differences(look_from_toml(to_toml(look), name), look), std::vector<std::string>{});
  }
}

TEST(Presets, AreEachAnotherWater) {
  for (const char* a : kPresets) {
    for (const char* b : kPresets) {
      EXPECT_EQ(differences(preset(a), preset(b)).empty(), std::string(a) == b) << a << ", " << b;
    }
  }
}

/// The attenuation of daylight with depth, as Jerlov measured it, is about a + b_b.
TEST(Presets, HarbourIsJerlovs7C) {
  const DepthFog::Params fog = preset("harbour").of<DepthFog>();
  const Rgb<double> a = Kernel<DepthFog>::absorption(fog), b = Kernel<DepthFog>::scattering(fog);
  const double g = fog.anisotropy;  // the share that is scattered back, of Henyey and Greenstein
  const double back = (1 - g) / (2 * g) * ((1 + g) / std::sqrt(1 + g * g) - 1);
  const Rgb<double> loss = 1.0395 * (a + back * b);
  const Rgb<double> jerlov = water_optics(WaterType::kJerlov7C).down_attenuation;
  EXPECT_NEAR(loss.r / jerlov.r, 1, 0.25);
  EXPECT_NEAR(loss.g / jerlov.g, 1, 0.25);
  EXPECT_NEAR(loss.b / jerlov.b, 1, 0.25);
}

/// The presets order murkiness and tile sizes as their names promise.
TEST(Presets, StandInOrder) {
  const auto murk = [](const char* name) {
    return Kernel<DepthFog>::extinction(preset(name).of<DepthFog>()).g;
  };
  EXPECT_LT(murk("pool"), murk("basin"));
  EXPECT_LT(murk("basin"), murk("creek"));
  EXPECT_LT(murk("creek"), murk("harbour"));
  const auto waves = [](const char* name) { return preset(name).of<WaveNormals>(); };
  EXPECT_LT(waves("basin").tile_size, waves("creek").tile_size);
  EXPECT_LT(waves("pool").tile_size, waves("harbour").tile_size);
  EXPECT_LT(waves("lake_at_dusk").tile_size, waves("open_sea").tile_size);
  for (const char* name : kPresets) EXPECT_LE(waves(name).wind, waves("open_sea").wind) << name;
}

TEST(Presets, FusedAgreesWithTheReference) {
  constexpr Size kSize{160, 60};
  const test::NoiseMap map(16, 8), sky(12, 6);
  test::Buffers buffers(rect_of(kSize));
  const Scene scene = test::simple_scene(kSize);
  const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
  for (int c = 0; c < 3; ++c) {
    buffers.set(plane_after(PlaneId::kColorR, c),
                [&](int x, int y) { return 0.5f * test::noise(x / 2, y / 2, c); });
  }
  buffers.set(PlaneId::kDepth, [&](int x, int y) {
    const double z = -3 / rays.ray_at(x + 0.5, y + 0.5).y;
    return z < 0 ? test::kInf : static_cast<float>(z);
  });
  buffers.frame.wave_map = map.texture;
  buffers.frame.environment = sky.texture;
  for (const char* name : kPresets) {
    const Look look = preset(name);
    const test::Picture judge = test::reference(look, buffers.frame, scene);
    for (const std::string& simd : {simd_targets().front(), std::string("scalar")}) {
      const test::Picture got = test::fused(look, buffers.frame, scene, {.simd = simd});
      int far = 0, wet = 0;
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          if (std::isinf(got.aov(Aov::kSurfaceDepth, x, y))) continue;
          ++wet;
          far += std::abs(got.color(x, y).g - judge.color(x, y).g) > 1e-3;
        }
      }
      EXPECT_GT(wet, 1000);
      EXPECT_LT(far, wet / 200) << name << ", " << simd
                                << ": a lookup between two texels may round";
    }
  }
}

}  // namespace
}  // namespace limpid

#include "judge/report/brought.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/files/text/look_file.h"
#include "limpid/plate/texture.h"

#include "judge/report/measure.h"
#include "judge/trace/finer_water.h"
#include "paths.h"

/// The rows of the report for buffers that a host brings: where they are judged, and that each
/// buffer reduces the error.

namespace limpid {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> added(PlaneSet planes) {
  std::vector<std::string> names;
  for (const Brought& step : brought_one_by_one(planes)) names.push_back(roles_text(step.added));
  return names;
}

TEST(Brought, OneBufferAfterTheOther) {
  PlaneSet all;
  for (const Role& role : roles()) all = all | role.planes();
  EXPECT_THAT(
      added(all),
      ElementsAre("color, depth", "shadow, sun_color", "reflection",
                  "reflection_valid, reflection_depth",
                  "surface_depth, surface_normal, below_color, below_depth, surface_shadow"));
  PlaneSet before;
  for (const Brought& step : brought_one_by_one(all)) {
    EXPECT_EQ(step.all, before | step.added);
    EXPECT_FALSE(before.meets(step.added));
    before = step.all;
  }
  EXPECT_EQ(before, all - kSkyPlanes - kAlbedoPlanes -
                        PlaneSet{PlaneId::kBasin});  // computed, never brought
}

TEST(Brought, WhatAPlateLacksIsNoStep) {
  const PlaneSet few = kColorPlanes | kReflectionPlanes | PlaneSet{PlaneId::kDepth};
  EXPECT_THAT(added(few), ElementsAre("color, depth", "reflection"));
}

TEST(Brought, WavesAreAsLongAsTheirSine) {
  const SineWave one{0.1, 3, 4, 0.5, 0};
  EXPECT_DOUBLE_EQ(wave_length(std::span(&one, 1)), 2 * std::numbers::pi / 5);
  // The RMS of equal slopes: the mean of the squares of 3 and 4.
  const SineWave two[] = {{1.0 / 3, 3, 0, 0, 0}, {1.0 / 4, 0, 4, 0, 0}};
  EXPECT_DOUBLE_EQ(wave_length(two), 2 * std::numbers::pi / std::sqrt(12.5));
  EXPECT_TRUE(std::isnan(wave_length(std::span<const SineWave>{})));
}

TEST(Brought, AMapIsMeasuredAsItTiles) {
  // Four waves across the map, one along it.
  Plane red({0, 0, 128, 32}), green({0, 0, 128, 32}), blue({0, 0, 128, 32});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 128; ++x) {
      const double slope = 0.01 * std::cos(2 * std::numbers::pi * 4 * x / 128.0);
      red.view().at(x, y) = static_cast<float>((slope + 1) / 2);
      green.view().at(x, y) = 0.5f;
      blue.view().at(x, y) = 1;
    }
  }
  const Texture map{.channels = {red.view(), green.view(), blue.view()}};
  EXPECT_NEAR(wave_length(map, 6), 6.0 / 4, 0.01);
}

TEST(Brought, NearIsWhereAPixelCoversLessThanAWave) {
  // 10 above the water, looking straight down: a pixel is 20 / 8 = 2.5 wide in the middle.
  Scene scene;
  scene.camera =
      Camera{glm::lookAt(glm::dvec3(0, 10, 0), glm::dvec3(0), glm::dvec3(0, 0, -1)),
             perspective(std::numbers::pi / 2, 1, 0.1, 100, ClipSpace::kGl), ClipSpace::kGl};
  scene.water = WaterPlane{};
  Plane color({0, 0, 8, 8});
  Frame frame;
  frame.display = {0, 0, 8, 8};
  for (int c = 0; c < 3; ++c) frame.planes[c] = color.view();
  const auto places = [&](double near) {
    return places_of(scene, frame, near, [](int, int y) { return y > 0; });
  };
  const auto share = [](const std::vector<Place>& list, Place place) {
    return static_cast<double>(std::count(list.begin(), list.end(), place)) / 64;
  };
  EXPECT_EQ(share(places(2.6), Place::kNear), 56 / 64.0);
  EXPECT_EQ(share(places(2.4), Place::kFar), 56 / 64.0);
  EXPECT_EQ(share(places(2.4), Place::kDry), 8 / 64.0);
  EXPECT_EQ(places(2.4).front(), Place::kDry);
  EXPECT_EQ(share(places(std::nan("")), Place::kNear), 56 / 64.0);  // calm: no waves to resolve
}

TEST(Brought, TowardsTheHorizonPixelsAreFar) {
  Scene scene;
  scene.camera = Camera{glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 2, -1), glm::dvec3(0, 1, 0)),
                        perspective(1, 1, 0.1, 1000, ClipSpace::kGl), ClipSpace::kGl};
  scene.water = WaterPlane{};
  Plane color({0, 0, 4, 64});
  Frame frame;
  frame.display = {0, 0, 4, 64};
  for (int c = 0; c < 3; ++c) frame.planes[c] = color.view();
  const std::vector<Place> places = places_of(scene, frame, 3, [](int, int y) { return y >= 31; });
  EXPECT_EQ(places[31 * 4], Place::kFar);  // above the horizon, where a crest may be
  EXPECT_EQ(places[32 * 4], Place::kFar);
  EXPECT_EQ(places[63 * 4], Place::kNear);
}

/// A square of water with sides of length `side` that begins at the eye, in `across` x `across`
/// squares, beside a dry triangle.
Model lake(float side, int across) {
  Model model;
  model.materials.emplace_back();
  model.meshes.resize(2);
  model.meshes[0].positions = {{0, 0, 0}, {side, 0, 0}, {0, side, 0}};
  model.meshes[0].indices = {0, 1, 2};
  Mesh& water = model.meshes[1];
  const auto n = static_cast<std::uint32_t>(across);
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      water.positions.push_back(side / float(across) * glm::vec3(x, y, 0));
    }
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, c = a + n + 1;
      water.indices.insert(water.indices.end(), {a, a + 1, c, c, a + 1, c + 1});
    }
  }
  model.instances = {{.mesh = 0}, {.mesh = 1, .water = true}};
  return model;
}

/// Measures of the water mesh: its area, the total length of the edges that belong to one triangle
/// only, and the longest edge whose middle is near the world's origin.
struct Measured {
  double area = 0, longest = 0, border = 0;

  Measured(const PartedWater& parted, double reach) {
    const Mesh& mesh =
        parted.model.meshes[static_cast<std::size_t>(parted.model.instances[1].mesh)];
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      const std::uint32_t* i = &mesh.indices[t];
      const auto at = [&](int k) { return glm::dvec3(mesh.positions[i[k % 3]]); };
      const double twice = glm::cross(at(1) - at(0), at(2) - at(0)).z;
      EXPECT_GT(twice, 0);  // all triangles are wound as before
      area += twice / 2;
      for (int k = 0; k < 3; ++k) {
        ++edges[std::minmax(i[k], i[(k + 1) % 3])];
        if (glm::length(0.5 * (at(k) + at(k + 1))) > reach) continue;
        longest = std::max(longest, glm::distance(at(k), at(k + 1)));
      }
    }
    for (const auto& [edge, triangles] : edges) {
      if (triangles != 1) continue;
      border += glm::distance(mesh.positions[edge.first], mesh.positions[edge.second]);
    }
  }
};

TEST(FinerWater, PartsTheEdgesThatAreTooLongForTheWaves) {
  const PartedWater parted = with_finer_water(lake(64, 2), {.shortest_wave = 8});
  EXPECT_EQ(parted.model.meshes[0].positions.size(), 3);
  EXPECT_TRUE(std::isinf(parted.reach));
  const Measured all(parted, 1e9), near(parted, 40);
  EXPECT_NEAR(all.area, 64 * 64, 1e-6);
  EXPECT_NEAR(all.border, 4 * 64, 1e-3);
  EXPECT_LE(all.longest, 0.01 * 64 * std::sqrt(2.0));
  EXPECT_LE(near.longest, 8 / 16.0 + 1e-6);
  EXPECT_GT(all.longest, near.longest);
}

TEST(FinerWater, NoHoleOpensWhereThePartedWaterEnds) {
  const PartedWater parted = with_finer_water(lake(512, 8), {.shortest_wave = 8, .most = 20'000});
  EXPECT_LE(parted.triangles, 20'000);
  EXPECT_GT(parted.triangles, 5'000);
  EXPECT_GE(parted.reach, 8);
  EXPECT_LT(parted.reach, 512);
  const Measured all(parted, 1e9), near(parted, 0.999 * parted.reach);
  EXPECT_NEAR(all.area, 512 * 512, 1e-3);
  EXPECT_NEAR(all.border, 4 * 512, 1e-2);  // the border of the square
  EXPECT_LE(near.longest, 8 / 4.0);
  EXPECT_GE(all.longest, 64);
}

TEST(FinerWater, ThatIsFineEnoughStaysAsItIs) {
  const Model model = lake(1, 4);
  const PartedWater fine = with_finer_water(model, {.shortest_wave = 6});
  EXPECT_EQ(fine.triangles, 32);
  const PartedWater full = with_finer_water(model, {.shortest_wave = 0.1, .most = 32});
  EXPECT_EQ(full.triangles, 32);
  EXPECT_EQ(full.reach, 0);
}

// ---- measured, small

class MeasureBrought : public ::testing::Test {
 protected:
  static Look look(const std::string& name) {
    return load_look(LIMPID_DATA "/looks/" + name + ".toml");
  }
  const BroughtRow& first(const std::string& name) const { return *row(name, false); }
  const BroughtRow& last(const std::string& name) const { return *row(name, true); }

  ReportOptions options_{.data = LIMPID_DATA, .size = {96, 54}, .rounds = 1};
  std::unique_ptr<Executor> one_ = make_executor(1), many_ = make_executor(2);
  Report report_;
  Measuring measuring_{
      options_, {look("physical"), look("fast")}, look("physical"), *one_, *many_, 2, "", report_};

 private:
  const BroughtRow* row(const std::string& name, bool is_last) const {
    const BroughtRow* found = nullptr;
    for (const BroughtRow& row : report_.brought) {
      if (row.look == name && (is_last || !found)) found = &row;
    }
    return found;
  }
};

TEST_F(MeasureBrought, AllBuffersBeatColorAndDepthOnAScene) {
  for (const char* scene : {"pool", "river"}) {
    report_ = {};
    measure_brought_scene(measuring_, std::string(LIMPID_DATA "/scenes/") + scene + ".toml");
    ASSERT_EQ(report_.brought.size(), 10) << scene;
    EXPECT_EQ(first("physical").brought, "color, depth");
    EXPECT_LT(last("physical").wet, 0.9 * first("physical").wet) << scene;
    EXPECT_LT(last("physical").flip, first("physical").flip) << scene;
    EXPECT_LT(last("fast").wet, first("fast").wet) << scene;
    EXPECT_LT(last("physical").wet, last("fast").wet) << scene;
    for (const BroughtRow& row : report_.brought) {
      EXPECT_GT(row.wet, 0) << scene << ", " << row.brought;
      EXPECT_LT(row.wet, 0.5) << scene << ", " << row.brought;
    }
    ASSERT_EQ(report_.brought_subjects.size(), 1);
    EXPECT_GT(report_.brought_subjects[0].wet_share, 0.2);
    EXPECT_GT(report_.brought_subjects[0].near_share, 0.5);
  }
}

TEST_F(MeasureBrought, TheTruthHasTheWavesThatTheLookIsGiven) {
  options_.size = {240, 135};
  measure_brought_scene(measuring_, LIMPID_DATA "/scenes/horizon.toml");
  // Water on the grid of the scene itself has an error of .09.
  EXPECT_LT(first("physical").wet, 0.07);
}

TEST_F(MeasureBrought, TheLagoonIsThePathTracedOneWithItsWaves) {
  measure_brought_lagoon(measuring_);
  ASSERT_EQ(report_.brought.size(), 8);  // its reflection has neither depth nor validity
  EXPECT_LT(first("physical").wet, 0.26);
  EXPECT_LT(last("physical").wet, 0.15);
  EXPECT_LT(last("physical").near, 0.11);
  EXPECT_GT(last("physical").far, last("physical").near);
  ASSERT_EQ(report_.brought_figures.size(), 5);  // the truth, and each row of physical
  EXPECT_NEAR(report_.brought_subjects[0].wave_length, 0.66, 0.01);
  EXPECT_NEAR(report_.brought_subjects[0].wet_share, 0.61, 0.01);
}

}  // namespace
}  // namespace limpid

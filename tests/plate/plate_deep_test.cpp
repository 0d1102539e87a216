#include <cmath>
#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "limpid/files/exr/exr_writer.h"
#include "limpid/plate/plate.h"

#include "files/exr/deep_files.h"
#include "files/exr/written.h"

/// Plates of deep samples: which samples become color and depth, and which the below buffers.

namespace limpid {
namespace {

using exr_test::DeepPicture;
using exr_test::point;
using exr_test::rgbaz;
using exr_test::volume;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kPost = 0.5f, kBottom = 0.25f;
const PlaneSet kDeepPlanes =
    kColorPlanes | kBelowPlanes | PlaneSet{PlaneId::kColorA, PlaneId::kDepth};

/// A camera 2 above the water looks straight down: the water's eye depth is 2 everywhere.
Scene scene(double height = 0) {
  Scene scene;
  scene.camera = Camera{glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0), glm::dvec3(0, 0, -1)),
                        perspective(1, 4.0 / 3, 0.1, 100, ClipSpace::kGl), ClipSpace::kGl};
  scene.water = WaterPlane{{0, 1, 0}, height};
  return scene;
}

/// Pixel (1, 1): a post at 1 before the bottom at 3; (2, 1): mist from 1 to 3; (0, 0): the bottom.
DeepPicture picture() {
  DeepPicture deep = rgbaz();
  deep.channels["ZBack"] = Imf::FLOAT;
  deep.samples[{1, 1}] = {point(3, kBottom, 1), point(1, kPost, 1)};
  deep.samples[{2, 1}] = {volume(1, 3, 0.3f, 0.75f)};
  deep.samples[{0, 0}] = {point(3, kBottom, 1)};
  return deep;
}

class DeepPlate : public testing::Test {
 protected:
  DeepPlate() { add_deep(picture()); }

  void add_deep(const DeepPicture& deep) {
    const std::filesystem::path path = test::own_folder() / "samples.exr";
    exr_test::write_deep_picture(path.string(), deep);
    request_.files = {path};
  }
  /// One value everywhere, in a file beside the deep one.
  std::string flat(const std::string& name, const std::vector<std::string>& channels, float value) {
    Plane plane(Rect{0, 0, 4, 3});
    for (int y = 0; y < 3; ++y) std::fill_n(plane.view().row(y), 4, value);
    ExrOutput output;
    output.data = output.display = {0, 0, 4, 3};
    for (const std::string& channel : channels) {
      output.channels.push_back({channel, plane.view(), false});
    }
    const std::filesystem::path path = test::own_folder() / name;
    write_exr(path, output);
    return path.string();
  }
  LoadedPlate read(const Scene& in, const DepthMeaning& depth = {}) const {
    const Plate plate = Plate::open(request_);
    return plate.read(plate.planes(), in, depth);
  }

  PlateRequest request_;
};

TEST_F(DeepPlate, ThePostHidesTheBottomAndTheSamplesKnowIt) {
  EXPECT_EQ(Plate::open(request_).planes(), kDeepPlanes);
  const LoadedPlate plate = read(scene());
  const auto at = [&](PlaneId id, int x, int y) { return plate.frame.plane(id).at(x, y); };
  EXPECT_EQ(at(PlaneId::kColorR, 1, 1), kPost);
  EXPECT_EQ(at(PlaneId::kColorB, 1, 1), 3 * kPost);
  EXPECT_EQ(at(PlaneId::kColorA, 1, 1), 1);
  EXPECT_EQ(at(PlaneId::kDepth, 1, 1), 1);
  EXPECT_EQ(at(PlaneId::kBelowR, 1, 1), kBottom);
  EXPECT_EQ(at(PlaneId::kBelowG, 1, 1), 2 * kBottom);
  EXPECT_EQ(at(PlaneId::kBelowB, 1, 1), 3 * kBottom);
  EXPECT_EQ(at(PlaneId::kBelowDepth, 1, 1), 3);
  // Half of the mist lies behind the surface at 2: half of its density.
  EXPECT_EQ(at(PlaneId::kDepth, 2, 1), 1);
  EXPECT_NEAR(at(PlaneId::kBelowDepth, 2, 1), 2, 1e-6);
  EXPECT_NEAR(at(PlaneId::kBelowR, 2, 1), 0.2f, 1e-6);
  EXPECT_EQ(at(PlaneId::kColorR, 3, 2), 0);
  EXPECT_EQ(at(PlaneId::kColorA, 3, 2), 0);
  EXPECT_EQ(at(PlaneId::kDepth, 3, 2), kInf);
  EXPECT_EQ(at(PlaneId::kBelowDepth, 3, 2), kInf);
}

TEST_F(DeepPlate, TheSurfaceOfThePlateWins) {
  request_.layers["surface_depth"] = flat("surface.exr", {"surface.Z"}, 3.5f);
  const LoadedPlate plate = read(scene());
  EXPECT_EQ(plate.frame.plane(PlaneId::kBelowDepth).at(1, 1), kInf);
  EXPECT_EQ(plate.frame.plane(PlaneId::kBelowR).at(1, 1), 0);
  // The surface depth is read even if the caller does not request it.
  const LoadedPlate below = Plate::open(request_).read(kBelowPlanes | kColorPlanes, scene(), {});
  EXPECT_EQ(below.frame.plane(PlaneId::kBelowDepth).at(1, 1), kInf);
}

TEST_F(DeepPlate, DistancesFromTheCameraBecomeEyeDepths) {
  DeepPicture deep = rgbaz();
  const Rays rays = rays_of(*scene().camera, {4, 3});
  const auto length = [&](int x, int y) {
    return static_cast<float>(glm::length(rays.ray_at(x + 0.5, y + 0.5)));
  };
  // In the corner the water has the eye depth 2 and the distance 2.46: 2.1 is above the water.
  ASSERT_GT(2 * length(0, 0), 2.2f);
  deep.samples[{0, 0}] = {point(2.1f, kPost, 1), point(3 * length(0, 0), kBottom, 1)};
  add_deep(deep);
  const LoadedPlate plate = read(scene(), {DepthKind::kRay});
  EXPECT_NEAR(plate.frame.plane(PlaneId::kDepth).at(0, 0), 2.1f / length(0, 0), 1e-6);
  EXPECT_NEAR(plate.frame.plane(PlaneId::kBelowDepth).at(0, 0), 3, 1e-6);
  EXPECT_EQ(plate.frame.plane(PlaneId::kBelowR).at(0, 0), kBottom);
  EXPECT_EQ(plate.frame.plane(PlaneId::kDepth).at(1, 1), kInf);
}

TEST_F(DeepPlate, AViewThatBeginsInTheWaterSeesAllOfIt) {
  const LoadedPlate plate = read(scene(5));
  EXPECT_EQ(plate.frame.plane(PlaneId::kBelowR).at(1, 1), kPost);
  EXPECT_EQ(plate.frame.plane(PlaneId::kBelowDepth).at(1, 1), 1);
}

TEST_F(DeepPlate, WhatTheUserGivesIsNotMadeUp) {
  request_.layers["below_color"] = "none";
  EXPECT_EQ(Plate::open(request_).planes(),
            kDeepPlanes - (kBelowPlanes - PlaneSet{PlaneId::kBelowDepth}));
  request_.layers["below_color"] = flat("below.exr", {"below.R", "below.G", "below.B"}, 0.75f);
  const LoadedPlate plate = read(scene());
  EXPECT_EQ(plate.frame.plane(PlaneId::kBelowR).at(1, 1), 0.75f);
  EXPECT_EQ(plate.frame.plane(PlaneId::kBelowDepth).at(1, 1), 3);
}

TEST_F(DeepPlate, BelowAloneMayBeDeep) {
  const std::string samples = request_.files[0].string();
  request_.files = {flat("dry.exr", {"R", "G", "B", "Z"}, 4)};
  EXPECT_FALSE(Plate::open(request_).planes().meets(kBelowPlanes));
  request_.layers = {{"below_color", samples}, {"below_depth", samples}};
  const LoadedPlate plate = read(scene());
  EXPECT_EQ(plate.frame.plane(PlaneId::kColorR).at(1, 1), 4);
  EXPECT_EQ(plate.frame.plane(PlaneId::kDepth).at(1, 1), 4);
  EXPECT_EQ(plate.frame.plane(PlaneId::kBelowR).at(1, 1), kBottom);
  EXPECT_EQ(plate.frame.plane(PlaneId::kBelowDepth).at(1, 1), 3);
}

TEST_F(DeepPlate, CountsWhatMeantNothing) {
  DeepPicture deep = picture();
  deep.samples[{3, 0}] = {point(std::nanf(""), 1, 1)};
  deep.samples[{3, 1}] = {point(3, kInf, 1)};
  add_deep(deep);
  const LoadedPlate plate = read(scene());
  EXPECT_EQ(plate.replaced.of(PlaneId::kDepth), (Replaced{1, 0}));
  EXPECT_EQ(plate.replaced.of(PlaneId::kColorR), (Replaced{0, 3}));
}

TEST_F(DeepPlate, InspectSaysWhatTheSamplesGive) {
  const std::string text = Plate::inspect(request_);
  EXPECT_THAT(text, HasSubstr(", deep\n"));
  EXPECT_THAT(text, ContainsRegex("color +R G B A +.*samples.exr"));
  EXPECT_THAT(text, ContainsRegex("\n  depth +Z "));
  EXPECT_THAT(text, ContainsRegex("below_color +R G B .*deep samples behind the water"));
  EXPECT_THAT(text, ContainsRegex("below_depth +Z .*deep samples behind the water"));
}

TEST_F(DeepPlate, RefusesKindsAndScenesThatDoNotSayWhereTheWaterIs) {
  for (const DepthKind kind : {DepthKind::kInverse, DepthKind::kNormalised, DepthKind::kDevice}) {
    const std::string error = test::error_of([&] { read(scene(), {kind, 0.1, 100}); });
    EXPECT_THAT(error, HasSubstr("samples.exr: holds deep samples: expected depth of kind eye"));
  }
  EXPECT_THAT(test::error_of([&] { read({}); }), HasSubstr("the scene has no camera"));
}

}  // namespace
}  // namespace limpid

#include "limpid/load/plate.h"

#include <deque>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "limpid/write/exr_writer.h"

#include "load/written.h"

namespace limpid {
namespace {

constexpr Rect kDisplay{0, 0, 8, 5}, kOverscan{-3, -2, 10, 6};

/// Files of one plate, all of one data window; the channels of a file are constant.
class PlateFiles {
 public:
  explicit PlateFiles(Rect data) : data_(data) {}

  void add(const std::vector<std::string>& channels, float level, const std::string& file) {
    ExrOutput output;
    output.data = data_;
    output.display = kDisplay;
    for (const std::string& channel : channels) {
      Plane& plane = planes_.emplace_back(data_);
      for (int y = data_.y0; y < data_.y1; ++y) {
        for (int x = data_.x0; x < data_.x1; ++x) plane.view().at(x, y) = level;
      }
      output.channels.push_back({channel, plane.view(), false});
    }
    request.files.push_back(test::own_folder() / file);
    write_exr(request.files.back(), output);
  }

  PlateRequest request;

 private:
  Rect data_;
  std::deque<Plane> planes_;
};

const std::vector<std::string> kDryChannels = {"color.R", "color.G", "color.B", "depth.Z"};
const std::vector<std::string> kMaskChannels = {"reflection.A", "surface_shadow.Y"};
const std::vector<std::string> kColorChannels = {"reflection.R", "reflection.G", "reflection.B",
                                                 "below.R",      "below.G",      "below.B"};
const std::vector<std::string> kDepthChannels = {"surface.Z", "reflection.Z", "below.Z"};

constexpr PlaneId kDepthPlanes[] = {PlaneId::kDepth, PlaneId::kSurfaceDepth,
                                    PlaneId::kReflectionDepth, PlaneId::kBelowDepth};
const PlaneSet kWaterPlanes = kReflectionPlanes | kBelowPlanes |
                              PlaneSet{PlaneId::kSurfaceDepth, PlaneId::kReflectionValid,
                                       PlaneId::kReflectionDepth, PlaneId::kSurfaceShadow};

LoadedPlate loaded(const PlateRequest& request, const Scene& scene = {},
                   const DepthMeaning& depth = {}) {
  const Plate plate = Plate::open(request);
  EXPECT_TRUE(plate.planes().covers(kWaterPlanes));
  return plate.read(plate.planes(), scene, depth);
}

TEST(Plate, OverscanSurvivesForEveryRole) {
  PlateFiles files(kOverscan);
  files.add(kDryChannels, 4, "dry.exr");
  files.add(kColorChannels, 0.5f, "colors.exr");
  files.add(kMaskChannels, 0.75f, "masks.exr");
  files.add(kDepthChannels, 3, "depths.exr");
  const LoadedPlate plate = loaded(files.request);
  EXPECT_EQ(plate.frame.work(), kDisplay);
  for (int i = 0; i < kPlaneCount; ++i) {
    const View<const float>& view = plate.frame.planes[static_cast<std::size_t>(i)];
    if (!kWaterPlanes.has(static_cast<PlaneId>(i))) continue;
    EXPECT_EQ(view.window, kOverscan) << i;
    EXPECT_GT(view.at(kOverscan.x0, kOverscan.y0), 0) << i;
    EXPECT_EQ(view.at(kOverscan.x0, kOverscan.y0), view.at(4, 2)) << i;
  }
  EXPECT_EQ(plate.frame.plane(PlaneId::kSurfaceShadow).at(9, 5), 0.75f);
  EXPECT_EQ(plate.frame.plane(PlaneId::kBelowB).at(9, 5), 0.5f);
  EXPECT_EQ(plate.frame.plane(PlaneId::kReflectionDepth).at(9, 5), 3);
}

TEST(Plate, WhatIsSmallerThanThePictureIsFilledUp) {
  PlateFiles files({2, 1, 6, 4});
  files.add(kColorChannels, 0.5f, "colors.exr");
  files.add(kMaskChannels, 0.75f, "masks.exr");
  files.add(kDepthChannels, 3, "depths.exr");
  PlateFiles dry(kDisplay);
  dry.add(kDryChannels, 4, "dry.exr");
  files.request.files.push_back(dry.request.files[0]);
  const LoadedPlate plate = loaded(files.request);
  const Frame& frame = plate.frame;
  for (const Role& role : roles()) {
    if ((role.planes() & kWaterPlanes).empty()) continue;
    EXPECT_EQ(frame.plane(role.first).window, kDisplay) << role.name;
    EXPECT_EQ(frame.plane(role.first).at(1, 2), role.missing) << role.name;
    EXPECT_NE(frame.plane(role.first).at(2, 2), role.missing) << role.name;
  }
}

TEST(Plate, DepthKindsHoldForEveryDepth) {
  PlateFiles files(kOverscan);
  files.add(kDryChannels, 4, "dry.exr");
  files.add(kColorChannels, 0.5f, "colors.exr");
  files.add(kMaskChannels, 0.75f, "masks.exr");
  files.add(kDepthChannels, 4, "depths.exr");
  Scene scene;
  scene.camera = Camera{glm::dmat4(1), perspective(1, 1.6, 0.1, 100, ClipSpace::kGl)};
  const LoadedPlate inverse = loaded(files.request, scene, {DepthKind::kInverse});
  const LoadedPlate ray = loaded(files.request, scene, {DepthKind::kRay});
  const double length =
      glm::length(rays_of(*scene.camera, {kDisplay.width(), kDisplay.height()}).ray_at(-1.5, 0.5));
  for (const PlaneId id : kDepthPlanes) {
    EXPECT_EQ(inverse.frame.plane(id).at(-2, 0), 0.25f) << index_of(id);
    EXPECT_NEAR(ray.frame.plane(id).at(-2, 0), 4 / length, 1e-6) << index_of(id);
  }
}

}  // namespace
}  // namespace limpid

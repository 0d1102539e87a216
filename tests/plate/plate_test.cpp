#include "limpid/plate/plate.h"

#include <cmath>
#include <cstring>
#include <deque>
#include <fstream>
#include <iterator>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_writer.h"

#include "files/exr/written.h"

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
                                                 "below.R",      "below.G",      "below.B",
                                                 "sun_color.R",  "sun_color.G",  "sun_color.B"};
const std::vector<std::string> kDepthChannels = {"surface.Z", "reflection.Z", "below.Z"};

constexpr PlaneId kDepthPlanes[] = {PlaneId::kDepth, PlaneId::kSurfaceDepth,
                                    PlaneId::kReflectionDepth, PlaneId::kBelowDepth};
const PlaneSet kWaterPlanes = kReflectionPlanes | kBelowPlanes | kSunColorPlanes |
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

/// Loses the only chunk of a file: the file opens, but none of its pixels can be read.
void lose_pixels(const std::filesystem::path& path) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  for (std::uint64_t at = 8; at + 8 < bytes.size(); ++at) {
    std::uint64_t place = 0;
    std::memcpy(&place, bytes.data() + at, sizeof place);
    if (place != at + 8) continue;  // the only chunk stands right behind the table
    file.seekp(static_cast<std::streamoff>(at));
    file.write("\0\0\0\0\0\0\0\0", 8);
    return;
  }
  FAIL() << path << " has no table of one chunk";
}

TEST(Plate, WhatIsNotWantedIsNotDecoded) {
  PlateFiles files(kOverscan);
  files.add(kDryChannels, 4, "dry.exr");
  files.add(kColorChannels, 0.5f, "colors.exr");
  files.add(kMaskChannels, 0.75f, "masks.exr");
  files.add(kDepthChannels, NAN, "depths.exr");
  lose_pixels(files.request.files[1]);
  lose_pixels(files.request.files[2]);
  const Plate plate = Plate::open(files.request);
  const PlaneSet dry = kColorPlanes | PlaneSet{PlaneId::kDepth};
  const PlaneSet wanted = dry | PlaneSet{PlaneId::kBelowDepth};
  const LoadedPlate loaded = plate.read(wanted, {}, {});
  for (int i = 0; i < kPlaneCount; ++i) {
    const PlaneId id = static_cast<PlaneId>(i);
    EXPECT_EQ(static_cast<bool>(loaded.frame.plane(id)), wanted.has(id)) << i;
    EXPECT_EQ(static_cast<bool>(loaded.planes[static_cast<std::size_t>(i)]), wanted.has(id)) << i;
  }
  // The file has three channels of NaN; only the wanted channel is read.
  EXPECT_EQ(loaded.replaced.total(), kOverscan.area());
  EXPECT_EQ(plate.read(dry, {}, {}).replaced.total(), 0);
  EXPECT_THROW(plate.read(dry | PlaneSet{PlaneId::kReflectionValid}, {}, {}), Error);
  EXPECT_THROW(plate.read(dry | kReflectionPlanes, {}, {}), Error);
}

TEST(Plate, IsReadIntoThePlanesOfTheOneBefore) {
  const PlaneSet dry = kColorPlanes | PlaneSet{PlaneId::kDepth};
  PlateFiles first(kOverscan), second(kOverscan), larger({-9, -9, 12, 12});
  first.add(kDryChannels, 4, "first.exr");
  first.add(kMaskChannels, 0.75f, "masks.exr");
  second.add(kDryChannels, 7, "second.exr");
  larger.add(kDryChannels, 9, "larger.exr");
  LoadedPlate loaded;
  Plate::open(first.request).read(dry | PlaneSet{PlaneId::kReflectionValid}, {}, {}, loaded);
  const float* const memory = loaded.frame.plane(PlaneId::kColorG).data;
  EXPECT_EQ(loaded.frame.plane(PlaneId::kReflectionValid).at(0, 0), 0.75f);
  Plate::open(second.request).read(dry, {}, {}, loaded);
  EXPECT_EQ(loaded.frame.plane(PlaneId::kColorG).data, memory);
  EXPECT_EQ(loaded.frame.plane(PlaneId::kColorG).at(0, 0), 7);
  EXPECT_FALSE(loaded.frame.plane(PlaneId::kReflectionValid)) << "that is the first's";
  Plate::open(larger.request).read(dry, {}, {}, loaded);
  EXPECT_EQ(loaded.frame.plane(PlaneId::kColorG).window, (Rect{-9, -9, 12, 12}));
  EXPECT_EQ(loaded.frame.plane(PlaneId::kColorG).at(-9, 11), 9);
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

/// Each file is within the limits: all files together would exceed them.
TEST(Plate, PlanesOfAFrameStayWithinTheLimitsTogether) {
  PlateFiles files({0, 0, 64, 512});
  files.add(kDryChannels, 4, "dry.exr");
  files.add(kMaskChannels, 1, "masks.exr");
  files.add(kColorChannels, 1, "colors.exr");
  files.add(kDepthChannels, 4, "depths.exr");
  const auto error = [](const PlateRequest& request) {
    const Plate plate = Plate::open(request);
    return test::error_of([&] { plate.read(plate.planes(), {}, {}); });
  };
  files.request.limits.max_memory = 18 * 64 * 512 * 4;
  EXPECT_EQ(error(files.request), "");
  files.request.limits.max_memory -= 1;
  EXPECT_THAT(error(files.request), testing::EndsWith(": the planes of the frame need more memory "
                                                      "than the limit of 2359295 bytes"));

  PlateFiles afar({1 << 29, 0, (1 << 29) + 2, 2});
  afar.add({"surface.Z"}, 4, "afar.exr");
  files.request.limits = {};
  files.request.files.back() = afar.request.files[0];
  EXPECT_EQ(
      error(files.request),
      "surface_depth: its data window and the picture span 536870914x5 pixels: expected sides "
      "of at most 65536 and 268435456 pixels");
}

TEST(Plate, AZeroOfDepthIsNothingWhereAlphaIsZero) {
  for (const float alpha : {0.0f, 1.0f}) {
    PlateFiles files(kDisplay);
    files.add({"color.R", "color.G", "color.B", "color.A"}, alpha, "color.exr");
    files.add({"depth.Z", "surface.Z"}, 0, "depth.exr");
    const Plate plate = Plate::open(files.request);
    const LoadedPlate loaded = plate.read(plate.planes(), {}, {});
    const float depth = loaded.frame.plane(PlaneId::kDepth).at(3, 3);
    EXPECT_EQ(std::isinf(depth), alpha == 0) << alpha;
    EXPECT_EQ(loaded.frame.plane(PlaneId::kSurfaceDepth).at(3, 3), 0) << "that has no alpha";
    const LoadedPlate asked = plate.read(plate.planes(), {}, {.nothing = 0});
    EXPECT_TRUE(std::isinf(asked.frame.plane(PlaneId::kDepth).at(3, 3)));
    EXPECT_TRUE(std::isinf(asked.frame.plane(PlaneId::kSurfaceDepth).at(3, 3)));
  }
}

TEST(Plate, KnowsWhichLayersARequestNames) {
  PlateFiles files(kDisplay);
  files.add(kDryChannels, 1, "dry.exr");
  EXPECT_TRUE(Plate::open(files.request).named_planes().empty());
  files.request.layers["depth"] = "depth.Z";
  EXPECT_EQ(Plate::open(files.request).named_planes(), PlaneSet{PlaneId::kDepth});
  files.request.layers = {{"shadow", "none"}};
  EXPECT_TRUE(Plate::open(files.request).named_planes().empty());
}

}  // namespace
}  // namespace limpid

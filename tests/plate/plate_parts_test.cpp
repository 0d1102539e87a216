#include <array>

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/plate/plate.h"

#include "files/exr/part_files.h"
#include "files/exr/written.h"

/// Plates whose buffers lie in several parts of a file, in several views, flat beside deep.

namespace limpid {
namespace {

using exr_test::level_at;
using exr_test::part_of;
using exr_test::write_parts;
using exr_test::WrittenPart;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

constexpr Rect kDisplay{0, 0, 24, 16};
const std::vector<std::string> kRgba = {"R", "G", "B", "A"};

class PlateParts : public testing::Test {
 protected:
  void write(const std::vector<WrittenPart>& parts) {
    const std::filesystem::path path = test::own_folder() / "parts.exr";
    write_parts(path, kDisplay, parts);
    request_.files = {path};
  }
  /// The value of the whole plate at pixel (5, 7).
  float at(PlaneId id) const {
    const Plate plate = Plate::open(request_);
    const LoadedPlate loaded = plate.read(plate.planes(), {}, {});
    return loaded.frame.plane(id).at(5, 7);
  }

  PlateRequest request_;
};

std::vector<WrittenPart> stereo() {
  std::vector<WrittenPart> parts = {
      part_of("rgba_left", kDisplay, kRgba, 1), part_of("depth_left", kDisplay, {"Z"}, 9),
      part_of("rgba_right", kDisplay, kRgba, 11), part_of("depth_right", kDisplay, {"Z"}, 19),
      part_of("shadow", kDisplay, {"Y"}, 0.25f)};
  for (WrittenPart& part : parts) {
    if (part.name.ends_with("left")) part.view = "left";
    if (part.name.ends_with("right")) part.view = "right";
  }
  parts[0].texts["shot/take"] = "of left";
  parts[2].texts["shot/take"] = "of right";
  return parts;
}

TEST_F(PlateParts, ColorDepthAndShadowMayLieInDifferentParts) {
  std::vector<WrittenPart> parts = {part_of("rgba", kDisplay, kRgba),
                                    part_of("depth", {-8, -8, 40, 24}, {"Z"}, 9),
                                    part_of("shadow", {4, 4, 10, 10}, {"Y"}, 0.25f)};
  parts[1].tile = 16;
  parts[2].compression = Imf::PIZ_COMPRESSION;
  write(parts);
  EXPECT_EQ(at(PlaneId::kColorG), level_at(2, 5, 7));
  EXPECT_EQ(at(PlaneId::kDepth), level_at(9, 5, 7));
  EXPECT_EQ(at(PlaneId::kShadow), level_at(0.25f, 5, 7));
  const LoadedPlate loaded = Plate::open(request_).read(
      kColorPlanes | PlaneSet{PlaneId::kDepth, PlaneId::kShadow}, {}, {});
  EXPECT_EQ(loaded.frame.plane(PlaneId::kDepth).window, (Rect{-8, -8, 40, 24}));
  EXPECT_EQ(loaded.frame.plane(PlaneId::kShadow).at(20, 12), 1);
}

TEST_F(PlateParts, AViewPicksAllRolesAndItsAttributes) {
  write(stereo());
  const auto take = [&] {
    const std::vector<char> bytes = Plate::open(request_).attributes().at("shot/take").bytes;
    return std::string(bytes.begin(), bytes.end());
  };
  for (const char* view : {"", "left"}) {
    request_.view = view;
    EXPECT_EQ(at(PlaneId::kColorR), level_at(1, 5, 7)) << view;
    EXPECT_EQ(at(PlaneId::kDepth), level_at(9, 5, 7)) << view;
    EXPECT_EQ(at(PlaneId::kShadow), level_at(0.25f, 5, 7)) << view;
    EXPECT_EQ(take(), "of left");
  }
  request_.view = "Right";
  EXPECT_EQ(at(PlaneId::kColorR), level_at(11, 5, 7));
  EXPECT_EQ(at(PlaneId::kDepth), level_at(19, 5, 7));
  EXPECT_EQ(at(PlaneId::kShadow), level_at(0.25f, 5, 7));
  EXPECT_EQ(take(), "of right");
}

TEST_F(PlateParts, TheViewIsThatOfTheColorThatWasNamed) {
  write(stereo());
  request_.layers["color"] = "rgba_right";
  EXPECT_EQ(at(PlaneId::kDepth), level_at(19, 5, 7));
  request_.layers["depth"] = "depth_left.Z";
  EXPECT_EQ(at(PlaneId::kDepth), level_at(9, 5, 7));
  EXPECT_THAT(Plate::inspect(request_), HasSubstr("\nviews\n  left, right (used)\n"));
}

TEST_F(PlateParts, AFileOfOnePartMayHoldSeveralViews) {
  WrittenPart part =
      part_of("", kDisplay, {"R", "G", "B", "Z", "right.R", "right.G", "right.B", "right.Z"});
  part.multi_view = {"left", "right"};
  write({part});
  EXPECT_EQ(at(PlaneId::kColorB), level_at(3, 5, 7));
  EXPECT_EQ(at(PlaneId::kDepth), level_at(4, 5, 7));
  EXPECT_EQ(Plate::open(request_).attributes().count("multiView"), 0u);
  request_.view = "right";
  EXPECT_EQ(at(PlaneId::kColorB), level_at(7, 5, 7));
  EXPECT_EQ(at(PlaneId::kDepth), level_at(8, 5, 7));
}

TEST_F(PlateParts, AnUnknownViewIsRefusedWithTheViewsThatThereAre) {
  const auto error = [&] { return test::error_of([&] { Plate::open(request_); }); };
  write(stereo());
  request_.view = "rigth";
  EXPECT_EQ(error(), "view 'rigth': expected one of left, right; did you mean 'right'?");
  EXPECT_EQ(test::error_of([&] { Plate::inspect(request_); }), error());
  write({part_of("rgba", kDisplay, kRgba), part_of("depth", kDisplay, {"Z"})});
  EXPECT_EQ(error(), "view 'rigth': expected none, since no plate has views");
}

TEST_F(PlateParts, InspectTellsPartsAndViews) {
  write(stereo());
  const std::string text = Plate::inspect(request_);
  EXPECT_THAT(text, HasSubstr("part 2 'rgba_right': 24x16, zip, scan lines, view right\n"));
  EXPECT_THAT(text, HasSubstr("\nviews\n  left (used), right\nfound\n"));
  EXPECT_THAT(text, ContainsRegex("\n  depth +Z +\\(.*parts.exr, part 1\\)  - part 'depth_left'"));
}

TEST_F(PlateParts, ChannelsOfOneRoleMayLieInSeveralParts) {
  write({part_of("a", kDisplay, {"R"}, 1), part_of("b", {4, 4, 24, 16}, {"R"}, 2),
         part_of("c", kDisplay, {"R", "Z"}, 3)});
  request_.layers["color"] = "a.R,b.R,c.R";
  request_.layers["depth"] = "c.Z";
  EXPECT_EQ(at(PlaneId::kColorR), level_at(1, 5, 7));
  EXPECT_EQ(at(PlaneId::kColorG), level_at(2, 5, 7));
  EXPECT_EQ(at(PlaneId::kColorB), level_at(3, 5, 7));
  const std::string inputs = Plate::open(request_).inputs_text(kColorPlanes);
  EXPECT_THAT(inputs, ContainsRegex("^color = \\[\\{file = \"[0-9a-f]+\", part = 0, channels = "
                                    "\\[\"R\"\\]\\}, \\{file = .*part = 1.*part = 2, "));
  request_.layers["color"] = "R";
  EXPECT_EQ(test::error_of([&] { Plate::open(request_); }),
            "color=R: 3 candidates fit equally well: a.R, b.R, c.R; choose one, as in --layer "
            "color=a.R");
}

TEST_F(PlateParts, DeepPartsMayStandBesideFlatOnes) {
  WrittenPart samples = part_of("samples", kDisplay, {"R", "G", "B", "A", "Z"}, 20);
  samples.deep = true;
  samples.channels["A"] = std::vector<float>(static_cast<std::size_t>(kDisplay.area()), 1);
  write({samples, part_of("rgba", kDisplay, kRgba, 1), part_of("depth", kDisplay, {"Z"}, 9)});
  EXPECT_EQ(at(PlaneId::kColorR), level_at(1, 5, 7));
  EXPECT_EQ(at(PlaneId::kDepth), level_at(9, 5, 7));
  // Deep and flat parts can have roles of their own.
  Scene scene;
  scene.camera = Camera{glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0), glm::dvec3(0, 0, -1)),
                        perspective(1, 1.5, 0.1, 100, ClipSpace::kGl), ClipSpace::kGl};
  scene.water = WaterPlane{{0, 1, 0}, 0};
  request_.layers = {{"below_color", "samples"}, {"below_depth", "samples"}};
  const Plate plate = Plate::open(request_);
  const LoadedPlate loaded = plate.read(plate.planes(), scene, {});
  EXPECT_EQ(loaded.frame.plane(PlaneId::kColorR).at(5, 7), level_at(1, 5, 7));
  EXPECT_EQ(loaded.frame.plane(PlaneId::kBelowR).at(5, 7), level_at(20, 5, 7));
  EXPECT_EQ(loaded.frame.plane(PlaneId::kBelowDepth).at(5, 7), level_at(24, 5, 7));
  request_.layers = {{"color", "samples"}};
  EXPECT_EQ(
      Plate::open(request_).read(kColorPlanes, scene, {}).frame.plane(PlaneId::kColorR).at(5, 7),
      level_at(20, 5, 7));
}

TEST_F(PlateParts, WhatTellsOfOtherChannelsIsNotHandedOn) {
  WrittenPart color = part_of("", kDisplay, {"R", "G", "B", "Z"});
  for (const char* name :
       {"cryptomatte/f834d0a/name", "cryptomatte/f834d0a/manifest", "BlenderMultiChannel",
        "nuke/full_layer_names", "limpid/plan", "owner", "shot/take"}) {
    color.texts[name] = "text";
  }
  write({color});
  std::vector<std::string> names;
  for (const auto& [name, attribute] : Plate::open(request_).attributes()) {
    if (attribute.type == "string") names.push_back(name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"owner", "shot/take"}));
}

}  // namespace
}  // namespace limpid

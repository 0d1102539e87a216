#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plate/named_layers.h"

namespace limpid {
namespace {

using test::chosen;
using test::kBlenderMultilayer;
using test::kRgb;
using test::Names;
using test::source;
using testing::HasSubstr;

const std::vector<LayerSource> kBlender = {source(0, "dry.exr", kBlenderMultilayer)};

TEST(ChooseLayer, ByChannel) {
  EXPECT_EQ(chosen("depth", "ViewLayer.Mist.Z", kBlender), "depth: ViewLayer.Mist.Z\n");
  EXPECT_EQ(chosen("depth", "viewlayer.depth.z", kBlender), "depth: ViewLayer.Depth.Z\n");
  EXPECT_EQ(chosen("depth", "Depth.Z", kBlender), "depth: ViewLayer.Depth.Z\n");
  EXPECT_EQ(chosen("depth", "ViewLayer.Normal.Z", kBlender), "depth: ViewLayer.Normal.Z\n");
  EXPECT_EQ(chosen("color", "Depth.Z", kBlender),
            "color: ViewLayer.Depth.Z ViewLayer.Depth.Z ViewLayer.Depth.Z\n");
}

TEST(ChooseLayer, ByList) {
  EXPECT_EQ(chosen("color", "DiffCol.R, DiffCol.G, DiffCol.B", kBlender),
            "color: ViewLayer.DiffCol.R ViewLayer.DiffCol.G ViewLayer.DiffCol.B\n");
  EXPECT_EQ(chosen("surface_normal", "B,G,R", {source(2, "n.exr", kRgb)}),
            "surface_normal: 2:B 2:G 2:R\n");
}

TEST(ChooseLayer, ByLayer) {
  EXPECT_EQ(chosen("depth", "ViewLayer.Depth", kBlender), "depth: ViewLayer.Depth.Z\n");
  EXPECT_EQ(chosen("depth", "depth", kBlender), "depth: ViewLayer.Depth.Z\n");
  EXPECT_EQ(chosen("shadow", "shadow catcher", kBlender), "shadow: ViewLayer.Shadow Catcher.R\n");
  EXPECT_EQ(chosen("surface_normal", "Normal", kBlender),
            "surface_normal: ViewLayer.Normal.X ViewLayer.Normal.Y ViewLayer.Normal.Z\n");
  EXPECT_EQ(chosen("reflection", "ViewLayer.Combined", kBlender),
            "reflection: ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B\n");
  EXPECT_EQ(chosen("depth", "normal",
                   {source(0, "p.exr", {"Z"}, "depth"), source(0, "p.exr", {"Z"}, "normal", 1)}),
            "depth: #1:Z\n");
}

TEST(ChooseLayer, ANameWithACommaIsTriedWhole) {
  EXPECT_EQ(chosen("depth", "rocks, sand.Z", {source(0, "a.exr", {"rocks, sand.Z"})}),
            "depth: rocks, sand.Z\n");
}

TEST(ChooseLayer, AWholeFile) {
  EXPECT_EQ(chosen("depth", "", {source(1, "far.exr", kRgb)}), "depth: 1:R\n");
  EXPECT_EQ(chosen("depth", "", kBlender), "depth: ViewLayer.Depth.Z\n");
  EXPECT_EQ(chosen("depth", "", {source(0, "a.exr", {"A", "B", "G", "R", "Z"})}), "depth: Z\n");
  EXPECT_EQ(chosen("depth", "", {source(0, "water_depth.exr", {"Z"})}), "depth: Z\n");
  EXPECT_EQ(chosen("surface_depth", "", {source(0, "a.exr", {"A", "B", "G", "R", "Z"})}),
            "surface_depth: Z\n");
  EXPECT_EQ(chosen("surface_depth", "", kBlender), "surface_depth: ViewLayer.Depth.Z\n");
  EXPECT_EQ(chosen("surface_normal", "", kBlender),
            "surface_normal: ViewLayer.Normal.X ViewLayer.Normal.Y ViewLayer.Normal.Z\n");
  EXPECT_EQ(chosen("reflection", "", {source(0, "mirror.exr", {"A", "B", "G", "R", "Z"})}),
            "reflection: R G B\n");
  EXPECT_EQ(chosen("shadow", "", {source(0, "a.exr", {"light.sun.V"})}), "shadow: light.sun.V\n");
  EXPECT_EQ(chosen("below_color", "", kBlender),
            "below_color: ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B\n");
  EXPECT_EQ(chosen("below_depth", "", kBlender), "below_depth: ViewLayer.Depth.Z\n");
  EXPECT_EQ(chosen("reflection_depth", "", kBlender), "reflection_depth: ViewLayer.Depth.Z\n");
  EXPECT_EQ(chosen("surface_shadow", "", kBlender), "surface_shadow: ViewLayer.Shadow.R\n");
  EXPECT_EQ(chosen("reflection_valid", "", {source(0, "a.exr", kRgb)}), "reflection_valid: R\n");
  EXPECT_EQ(chosen("reflection_valid", "", {source(0, "a.exr", {"reflection.A", "reflection.R"})}),
            "reflection_valid: reflection.A\n");
}

TEST(ChooseLayer, AWholeFileWithNothingForTheRole) {
  EXPECT_EQ(
      chosen("surface_normal", "", {source(0, "a.exr", {"Z", "left.A", "mask.A"})}),
      "surface_normal=a.exr: no layer has a known name for surface_normal; name its channels; "
      "there is Z, left (A), mask (A)");
}

TEST(ChooseLayer, AMisspeltNameGetsTheNearest) {
  const std::vector<LayerSource> small = {
      source(0, "a.exr", {"A", "B", "G", "R", "ViewLayer.Depth.Z"})};
  EXPECT_EQ(chosen("depth", "ViewLayer.Dept.Z", small),
            "depth=ViewLayer.Dept.Z: no channel or layer 'ViewLayer.Dept.Z'; there is R G B A, "
            "ViewLayer.Depth (Z); did you mean 'ViewLayer.Depth.Z'?");
  EXPECT_EQ(chosen("color", "R,G,Blue sky", small),
            "color=R,G,Blue sky: no channel or layer 'Blue sky'; there is R G B A, "
            "ViewLayer.Depth (Z)");
  EXPECT_THAT(chosen("depth", "Z", {}), HasSubstr("there is no channel"));
}

TEST(ChooseLayer, AWrongCountSaysHowManyAreNeeded) {
  EXPECT_EQ(chosen("depth", "DiffCol.R,DiffCol.G", kBlender),
            "depth=DiffCol.R,DiffCol.G means 2 channels: depth needs 1 channel");
  EXPECT_EQ(chosen("color", "DiffCol.R,DiffCol.G", kBlender),
            "color=DiffCol.R,DiffCol.G means 2 channels: color needs 4 channels, 3 (no alpha) or "
            "1 (gray)");
  EXPECT_EQ(chosen("reflection", "Normal.X,Normal.Y", kBlender),
            "reflection=Normal.X,Normal.Y means 2 channels: reflection needs 3 channels or 1 "
            "(gray)");
  EXPECT_EQ(chosen("surface_normal", "Depth.Z", kBlender),
            "surface_normal=Depth.Z means 1 channel: surface_normal needs 3 channels");
  EXPECT_EQ(chosen("depth", "Normal", kBlender),
            "depth=Normal means 3 channels: depth needs 1 channel");
}

TEST(ChooseLayer, AnUnclearNameListsWhatItMayMean) {
  EXPECT_THAT(
      chosen("depth", "Z", kBlender),
      HasSubstr("depth=Z: 4 candidates fit equally well: ViewLayer.Depth.Z, ViewLayer.Mist.Z, "
                "ViewLayer.Normal.Z, ViewLayer.Position.Z; choose one"));
}

}  // namespace
}  // namespace limpid

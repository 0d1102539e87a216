#include "limpid/plate/layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "plate/named_layers.h"

namespace limpid {
namespace {

using test::chosen;
using test::kBlenderMultilayer;
using test::kRgb;
using test::kRgba;
using test::Names;
using test::source;
using test::text_of;
using testing::HasSubstr;

std::string found_in(const std::vector<LayerSource>& sources) {
  try {
    return text_of(find_layers(sources));
  } catch (const Error& error) {
    return error.what();
  }
}

std::string found(const Names& channels, const std::string& file_name = "plate.exr") {
  return found_in({source(0, file_name, channels)});
}

TEST(FindLayers, BlenderMultilayer) {
  EXPECT_EQ(found(kBlenderMultilayer),
            "color: ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B "
            "ViewLayer.Combined.A\n"
            "depth: ViewLayer.Depth.Z\n"
            "shadow: ViewLayer.Shadow.R\n");
}

TEST(FindLayers, BlenderPassesThatOnlyLookLikeIt) {
  EXPECT_EQ(found({"ViewLayer.Denoising Albedo.B",
                   "ViewLayer.Denoising Albedo.G",
                   "ViewLayer.Denoising Albedo.R",
                   "ViewLayer.Denoising Depth.Z",
                   "ViewLayer.Denoising Normal.X",
                   "ViewLayer.Denoising Normal.Y",
                   "ViewLayer.Denoising Normal.Z",
                   "ViewLayer.IndexOB.X",
                   "ViewLayer.Mist.Z",
                   "ViewLayer.Noisy Image.A",
                   "ViewLayer.Noisy Image.B",
                   "ViewLayer.Noisy Image.G",
                   "ViewLayer.Noisy Image.R",
                   "ViewLayer.Normal.X",
                   "ViewLayer.Normal.Y",
                   "ViewLayer.Normal.Z",
                   "ViewLayer.Shadow Catcher.R",
                   "ViewLayer.Vector.W",
                   "ViewLayer.Vector.X",
                   "ViewLayer.Vector.Y",
                   "ViewLayer.Vector.Z"}),
            "");
}

TEST(FindLayers, ViewLayerNamesAreFreeText) {
  EXPECT_EQ(found({"my rocks.v2.Combined.B", "my rocks.v2.Combined.G", "my rocks.v2.Combined.R",
                   "my rocks.v2.Depth.Z"}),
            "color: my rocks.v2.Combined.R my rocks.v2.Combined.G my rocks.v2.Combined.B\n"
            "depth: my rocks.v2.Depth.Z\n");
}

TEST(FindLayers, ViewLayerOfTheWater) {
  EXPECT_EQ(found({"Dry.Combined.B", "Dry.Combined.G", "Dry.Combined.R", "Dry.Depth.Z",
                   "Dry.Normal.X", "Dry.Normal.Y", "Dry.Normal.Z", "Water.Combined.B",
                   "Water.Combined.G", "Water.Combined.R", "Water.Depth.Z", "Water.Normal.X",
                   "Water.Normal.Y", "Water.Normal.Z"}),
            "color: Dry.Combined.R Dry.Combined.G Dry.Combined.B\n"
            "depth: Dry.Depth.Z\n"
            "surface_depth: Water.Depth.Z\n"
            "surface_normal: Water.Normal.X Water.Normal.Y Water.Normal.Z\n");
}

TEST(FindLayers, BlenderSingleLayer) {
  EXPECT_EQ(found({"A", "B", "G", "R", "Z"}), "color: R G B A\ndepth: Z\n");
}

TEST(FindLayers, TiledFileWithoutAlphaGivesThreeChannels) {
  EXPECT_EQ(found({"B", "G", "R", "Z"}, "oiio_tiled_rgbz_noalpha.exr"), "color: R G B\ndepth: Z\n");
}

TEST(FindLayers, BlenderFileOutput) {
  EXPECT_EQ(found({"depth.V",        "image.A",           "image.B",           "image.G",
                   "image.R",        "my layer/pos.v1.X", "my layer/pos.v1.Y", "my layer/pos.v1.Z",
                   "passes/color.A", "passes/color.B",    "passes/color.G",    "passes/color.R",
                   "shadow.A",       "shadow.B",          "shadow.G",          "shadow.R",
                   "water normal.X", "water normal.Y",    "water normal.Z",    "water_depth.V"},
                  "compo_ml.exr0001.exr"),
            "color: passes/color.R passes/color.G passes/color.B passes/color.A\n"
            "depth: depth.V\n"
            "shadow: shadow.R\n"
            "surface_depth: water_depth.V\n"
            "surface_normal: water normal.X water normal.Y water normal.Z\n");
}

TEST(FindLayers, GrayDepthInAFileOfItsOwn) {
  EXPECT_EQ(found_in({source(0, "color0001.exr", kRgba), source(1, "depth0001.exr", kRgb),
                      source(2, "normal0001.exr", kRgb), source(3, "shadow0001.exr", kRgba)}),
            "color: R G B A\ndepth: 1:R\nshadow: 3:R\n");
}

TEST(FindLayers, Nuke) {
  EXPECT_EQ(found({"A", "B", "G", "R", "depth.Z", "forward.u", "forward.v", "other.mask"}),
            "color: R G B A\ndepth: depth.Z\n");
  EXPECT_EQ(found({"depth.Z", "rgba.alpha", "rgba.blue", "rgba.green", "rgba.red"}),
            "color: rgba.red rgba.green rgba.blue rgba.alpha\ndepth: depth.Z\n");
  EXPECT_EQ(found({"alpha", "blue", "green", "red", "character.alpha", "character.blue",
                   "character.green", "character.red"}),
            "color: red green blue alpha\n");
}

TEST(FindLayers, LetterCaseDoesNotCount) {
  EXPECT_EQ(found({"RED", "Green", "b", "DEPTH.z"}), "color: RED Green b\ndepth: DEPTH.z\n");
}

TEST(FindLayers, NatronWritesALooseDepth) {
  EXPECT_EQ(found({"A", "B", "Depth", "G", "R"}), "color: R G B A\ndepth: Depth\n");
}

TEST(FindLayers, ArnoldAndKarma) {
  EXPECT_EQ(found({"A",
                   "B",
                   "G",
                   "N.X",
                   "N.Y",
                   "N.Z",
                   "P.X",
                   "P.Y",
                   "P.Z",
                   "R",
                   "Z",
                   "albedo.B",
                   "albedo.G",
                   "albedo.R",
                   "crypto_asset00.alpha",
                   "crypto_asset00.blue",
                   "crypto_asset00.green",
                   "crypto_asset00.red",
                   "motionvector.X",
                   "motionvector.Y",
                   "shadow_matte.B",
                   "shadow_matte.G",
                   "shadow_matte.R"}),
            "color: R G B A\ndepth: Z\nshadow: shadow_matte.R\n");
  EXPECT_EQ(found({"A", "B", "G", "R", "Z", "shadow_mask"}),
            "color: R G B A\ndepth: Z\nshadow: shadow_mask\n");
}

/// Movie Render Queue: the world's depth is gray, beside the final image with a layer or without.
TEST(FindLayers, Unreal) {
  for (const std::string image : {"", "FinalImage."}) {
    std::vector<std::string> channels;
    for (const char* component : {"A", "B", "G", "R"}) channels.push_back(image + component);
    for (const std::string layer :
         {"ActorHitProxyMask00.", "FinalImageMovieRenderQueue_MotionVectors.",
          "FinalImageMovieRenderQueue_WorldDepth."}) {
      for (const char* component : {"A", "B", "G", "R"}) channels.push_back(layer + component);
    }
    EXPECT_EQ(found(channels), "color: " + image + "R " + image + "G " + image + "B " + image +
                                   "A\ndepth: FinalImageMovieRenderQueue_WorldDepth.R\n");
  }
}

TEST(FindLayers, VRayNormalsAreOfTheDryScene) {
  EXPECT_EQ(found({"A",
                   "B",
                   "G",
                   "GI.B",
                   "GI.G",
                   "GI.R",
                   "R",
                   "Z",
                   "normals.X",
                   "normals.Y",
                   "normals.Z",
                   "reflect.B",
                   "reflect.G",
                   "reflect.R",
                   "refract.B",
                   "refract.G",
                   "refract.R",
                   "uCryptoWildcard00.A",
                   "uCryptoWildcard00.B",
                   "uCryptoWildcard00.G",
                   "uCryptoWildcard00.R"}),
            "color: R G B A\ndepth: Z\n");
}

TEST(FindLayers, PartNamesAreLayers) {
  EXPECT_EQ(found_in({source(0, "oiio_multipart.exr", kRgba, "beauty"),
                      source(0, "oiio_multipart.exr", {"Z"}, "depth", 1),
                      source(0, "oiio_multipart.exr", {"N.X", "N.Y", "N.Z"}, "normal", 2)}),
            "color: R G B A\ndepth: #1:Z\n");
  EXPECT_EQ(found_in({source(0, "nuke.exr", {"B", "G", "R"}, "rgba"),
                      source(0, "nuke.exr", {"Z"}, "water_depth", 1),
                      source(0, "nuke.exr", {"B", "G", "R"}, "diffuse", 2),
                      source(0, "nuke.exr", {"X", "Y", "Z"}, "Water Normals", 3),
                      source(0, "nuke.exr", {"B", "G", "R"}, "reflection", 4)}),
            "color: R G B\n"
            "reflection: #4:R #4:G #4:B\n"
            "surface_depth: #1:Z\n"
            "surface_normal: #3:X #3:Y #3:Z\n");
}

TEST(FindLayers, DepthOfAPartByAnyNameOfItsChannel) {
  for (const std::string part : {"Z", "depth", "Depth"}) {
    for (const std::string channel : {"Z", "Y", "depth", "depth.Z"}) {
      EXPECT_EQ(
          found_in({source(0, "a.exr", kRgba, "rgba"), source(0, "a.exr", {channel}, part, 1)}),
          "color: R G B A\ndepth: #1:" + channel + "\n")
          << part;
    }
  }
}

TEST(FindLayers, TheOnlyPartWithAPictureMayBeCalledAnything) {
  const Names rgbaz = {"A", "B", "G", "R", "Z"};
  EXPECT_EQ(found_in({source(0, "a.exr", rgbaz, "main"), source(0, "a.exr", kRgb, "diffuse", 1)}),
            "color: R G B A\ndepth: Z\n");
  EXPECT_EQ(
      found_in(
          {source(0, "a.exr", rgbaz, "shot010"), source(0, "a.exr", {"X", "Y", "Z"}, "position", 1),
           source(0, "a.exr", kRgb, "normals", 2), source(0, "a.exr", kRgb, "water beauty", 3)}),
      "color: R G B A\ndepth: Z\n");
  EXPECT_EQ(found_in({source(0, "a.exr", kRgb, "shot010"), source(0, "a.exr", {"Z"}, "mist", 1)}),
            "color: R G B\n");
  EXPECT_EQ(found_in({source(0, "a.exr", rgbaz, "one"), source(0, "a.exr", kRgb, "two", 1)}),
            "color: 2 candidates fit equally well: one, two; choose one, as in --layer color=one");
}

TEST(FindLayers, FlatPixelsWinOverDeepSamples) {
  LayerSource deep = source(0, "a.exr", {"A", "B", "G", "R", "Z"}, "samples");
  deep.deep = true;
  const LayerSource flat = source(0, "a.exr", {"A", "B", "G", "R", "Z"}, "pixels", 1);
  EXPECT_EQ(found_in({deep, flat}), "color: #1:R #1:G #1:B #1:A\ndepth: #1:Z\n");
  EXPECT_EQ(found_in({deep}), "color: R G B A\ndepth: Z\n");
}

TEST(FindLayers, DepthBesideTheColorOfAPart) {
  EXPECT_EQ(found_in({source(0, "a.exr", {"A", "B", "G", "R", "Z"}, "rgba"),
                      source(0, "a.exr", {"B", "G", "R"}, "diffuse", 1)}),
            "color: R G B A\ndepth: Z\n");
}

TEST(FindLayers, TheOnlyPartMayBeCalledAnything) {
  EXPECT_EQ(found_in({source(0, "a.exr", {"B", "G", "R", "Z"}, "rgba_shot010")}),
            "color: R G B\ndepth: Z\n");
  EXPECT_EQ(found_in({source(0, "a.exr", {"Z"}, "water_depth")}), "surface_depth: Z\n");
}

TEST(FindLayers, OurOwnNames) {
  EXPECT_EQ(
      found({"below.B",      "below.G",      "below.R",         "below.Z",      "color.A",
             "color.B",      "color.G",      "color.R",         "depth.Z",      "reflection.A",
             "reflection.B", "reflection.G", "reflection.R",    "reflection.Z", "shadow.Y",
             "sun_color.B",  "sun_color.G",  "sun_color.R",     "surface.NX",   "surface.NY",
             "surface.NZ",   "surface.Z",    "surface_shadow.Y"}),
      "color: color.R color.G color.B color.A\n"
      "depth: depth.Z\n"
      "shadow: shadow.Y\n"
      "reflection: reflection.R reflection.G reflection.B\n"
      "surface_depth: surface.Z\n"
      "surface_normal: surface.NX surface.NY surface.NZ\n"
      "reflection_valid: reflection.A\n"
      "reflection_depth: reflection.Z\n"
      "below_color: below.R below.G below.B\n"
      "below_depth: below.Z\n"
      "surface_shadow: surface_shadow.Y\n"
      "sun_color: sun_color.R sun_color.G sun_color.B\n");
}

TEST(FindLayers, RolesAreLayersByTheirNames) {
  EXPECT_EQ(found({"below_color.B", "below_color.G", "below_color.R", "below_depth.Z",
                   "reflection_depth.V", "reflection_valid.Y", "water shadow.R"}),
            "reflection_valid: reflection_valid.Y\n"
            "reflection_depth: reflection_depth.V\n"
            "below_color: below_color.R below_color.G below_color.B\n"
            "below_depth: below_depth.Z\n"
            "surface_shadow: water shadow.R\n");
  EXPECT_EQ(found({"View.Below Colour.B", "View.Below Colour.G", "View.Below Colour.R",
                   "View.Water Reflection Depth.Z", "View.Surface Shadow.Y"}),
            "reflection_depth: View.Water Reflection Depth.Z\n"
            "below_color: View.Below Colour.R View.Below Colour.G View.Below Colour.B\n"
            "surface_shadow: View.Surface Shadow.Y\n");
}

TEST(FindLayers, ThePictureOfTheSunsLightAlone) {
  const auto layer = [](const std::string& name) {
    return Names{name + ".A", name + ".B", name + ".G", name + ".R"};
  };
  for (const std::string name :
       {"View.Sun Color", "ViewLayer.Combined_Sun", "diffuse_direct_sun", "directdiffuse_sun"}) {
    EXPECT_EQ(found(layer(name)), "sun_color: " + name + ".R " + name + ".G " + name + ".B\n");
  }
  EXPECT_EQ(found(kRgba, "shot_SunColor.0007.exr"), "sun_color: R G B\n");
  for (const std::string name :
       {"ViewLayer.Combined_Lamp", "ViewLayer.DiffDir", "diffuse_direct_sky", "sun"}) {
    EXPECT_EQ(found(layer(name)), "") << name;
  }
}

// Only limpid's own reflection buffers keep a mask in alpha; other renderers' alpha is no mask.
TEST(FindLayers, OnlyOurOwnReflectionHasItsMaskInAlpha) {
  EXPECT_EQ(found({"View.reflection.A", "View.reflection.B", "View.reflection.G",
                   "View.reflection.R", "View.reflection.Z"}),
            "reflection: View.reflection.R View.reflection.G View.reflection.B\n");
  EXPECT_EQ(found(kRgba, "reflection.exr"), "reflection: R G B\n");
}

TEST(FindLayers, OurOwnNamesWinOverLayersAndThoseOverFileNames) {
  EXPECT_EQ(found({"ViewLayer.Depth.Z", "depth.Z"}), "depth: depth.Z\n");
  EXPECT_EQ(found_in({source(0, "a.exr", {"ViewLayer.Depth.Z"}), source(1, "depth.exr", {"Z"})}),
            "depth: ViewLayer.Depth.Z\n");
  EXPECT_EQ(found_in({source(0, "a.exr", {"B", "G", "R", "Z"}), source(1, "depth.exr", {"Z"})}),
            "color: R G B\ndepth: 1:Z\n");
}

TEST(FindLayers, FilesOfOneKindByTheirNames) {
  EXPECT_EQ(
      found_in({source(0, "dry_color.exr", kRgba), source(1, "dry_depth.exr", {"Z"}),
                source(2, "dry_normal.exr", {"X", "Y", "Z"}), source(3, "reflection.exr", kRgba),
                source(4, "shadow.exr", {"Y"}), source(5, "water_depth.exr", {"Z"}),
                source(6, "water_normal_waves.exr", {"X", "Y", "Z"}),
                source(7, "water_shadow.exr", {"Y"}), source(8, "truth_flat.exr", kRgb),
                source(9, "below_color.exr", kRgb), source(10, "below_depth.exr", {"Z"}),
                source(11, "reflection_depth.exr", {"Z"}),
                source(12, "reflection_valid.exr", {"Y"})}),
      "color: R G B A\n"
      "depth: 1:Z\n"
      "shadow: 4:Y\n"
      "reflection: 3:R 3:G 3:B\n"
      "surface_depth: 5:Z\n"
      "surface_normal: 6:X 6:Y 6:Z\n"
      "reflection_valid: 12:Y\n"
      "reflection_depth: 11:Z\n"
      "below_color: 9:R 9:G 9:B\n"
      "below_depth: 10:Z\n"
      "surface_shadow: 7:Y\n");
}

TEST(FindLayers, WaterFilesNeverFeedTheDryScene) {
  EXPECT_EQ(found({"Z"}, "water_depth.exr"), "surface_depth: Z\n");
  EXPECT_EQ(found({"Z"}, "WaterZ.0001.exr"), "surface_depth: Z\n");
  EXPECT_EQ(found({"ViewLayer.Depth.Z"}, "water_depth.exr"), "surface_depth: ViewLayer.Depth.Z\n");
  EXPECT_EQ(found({"depth.Z"}, "surface_depth.exr"), "surface_depth: depth.Z\n");
  EXPECT_EQ(found({"Y"}, "water_shadow.exr"), "surface_shadow: Y\n");
  EXPECT_EQ(found({"Y"}, "SurfaceShadow_v2.exr"), "surface_shadow: Y\n");
  EXPECT_EQ(found({"Z"}, "reflection_depth.exr"), "reflection_depth: Z\n");
  EXPECT_EQ(found({"Z"}, "below_depth.exr"), "below_depth: Z\n");
  EXPECT_EQ(found({"Z"}, "reflection.exr"), "");
  EXPECT_EQ(found({"Y"}, "water_reflection_shadow.exr"), "");
}

TEST(FindLayers, DryNormalsAreNoSurfaceAndNoDepth) {
  for (const Names& normal : {Names{"X", "Y", "Z"}, Names{"B", "G", "R"}}) {
    EXPECT_EQ(found(normal, "dry_normal.exr"), "");
  }
  EXPECT_EQ(found({"X", "Y", "Z"}), "");
  EXPECT_EQ(found({"depth.X", "depth.Y", "depth.Z"}), "");
}

TEST(FindLayers, TheNameOfAWholePlateSaysNothing) {
  EXPECT_EQ(found({"A", "B", "G", "R", "Z"}, "water_shot_depth_shadow.exr"),
            "color: R G B A\ndepth: Z\n");
  EXPECT_EQ(found(kRgba, "underwater.exr"), "color: R G B A\n");
  EXPECT_EQ(found(kRgba, "water_shot.exr"), "color: R G B A\n");
  EXPECT_EQ(found({"View.Combined.B", "View.Combined.G", "View.Combined.R"}, "water_shot.exr"),
            "color: View.Combined.R View.Combined.G View.Combined.B\n");
  EXPECT_EQ(found({"Z"}, "waterfall.exr"), "depth: Z\n");
}

TEST(FindLayers, AGrayPictureFeedsRedGreenAndBlue) {
  EXPECT_EQ(found({"Y"}, "dry_color.exr"), "color: Y Y Y\n");
  EXPECT_EQ(found({"reflection.Y"}), "reflection: reflection.Y reflection.Y reflection.Y\n");
}

TEST(FindLayers, NothingIsFoundInNothing) {
  EXPECT_EQ(found_in({}), "");
  EXPECT_EQ(found(Names{}), "");
  EXPECT_EQ(found({".", "..", "R.", ".Z.", ""}), "");
}

TEST(FindLayers, ReasonsAreTold) {
  const auto reason = [](const std::vector<LayerSource>& sources, std::string_view role) {
    return find_layer(role_named(role), sources)->reason;
  };
  EXPECT_EQ(reason({source(0, "a.exr", kBlenderMultilayer)}, "depth"),
            "layer 'ViewLayer.Depth' (Blender, Nuke, Natron)");
  EXPECT_EQ(reason({source(0, "a.exr", {"Z"}, "depth")}, "depth"),
            "part 'depth' (Blender, Nuke, Natron)");
  EXPECT_EQ(reason({source(0, "a.exr", {"shadow_mask"})}, "shadow"),
            "channel 'shadow_mask' (Arnold, Karma)");
  EXPECT_EQ(reason({source(0, "a.exr", kRgba)}, "color"),
            "channels without a layer (Blender, Nuke, Arnold, Karma, V-Ray, Unreal)");
  EXPECT_EQ(reason({source(0, "shadow.exr", {"Y"})}, "shadow"), "the file's name");
}

TEST(FindLayers, SeveralViewLayersAreAmbiguous) {
  EXPECT_EQ(found({"Near.Combined.B", "Near.Combined.G", "Near.Combined.R", "Far.Combined.B",
                   "Far.Combined.G", "Far.Combined.R"}),
            "color: 2 candidates fit equally well: Near.Combined, Far.Combined; choose one, as in "
            "--layer color=Near.Combined");
}

TEST(FindLayers, SeveralFilesAreAmbiguous) {
  EXPECT_EQ(found_in({source(0, "a.exr", {"Z"}), source(1, "b.exr", {"Z"})}),
            "depth: 2 candidates fit equally well: a.exr:Z, b.exr:Z; choose one, as in --layer "
            "depth=a.exr:Z");
}

TEST(FindLayers, ALongListIsCutShort) {
  Names channels;
  for (int i = 0; i < 100; ++i) channels.push_back("layer" + std::to_string(i) + ".Depth.Z");
  EXPECT_THAT(found(channels), HasSubstr("layer22.Depth.Z, layer23.Depth.Z, 76 more; choose one"));
  EXPECT_THAT(chosen("depth", "nothing like it", {source(0, "a.exr", channels)}),
              HasSubstr("layer23.Depth (Z), 76 more"));
}

TEST(FindLayers, WhatTheUserDecidedIsNotLookedFor) {
  const std::vector<LayerSource> sources = {source(0, "a.exr", {"B", "G", "R", "Z"}),
                                            source(1, "b.exr", {"Z"})};
  EXPECT_THROW(find_layers(sources), Error);
  EXPECT_EQ(text_of(find_layers(sources, {{"depth", "b.exr"}})), "color: R G B\n");
}

TEST(FindLayers, EveryCandidateOfAnAmbiguityCanBeChosenByItsText) {
  const Names channels = {"A.Depth.Z", "View.rgba.B", "View.rgba.G", "View.rgba.R"};
  const std::vector<LayerSource> sources = {source(0, "s.exr", channels, "near", 0),
                                            source(0, "s.exr", channels, "far", 1)};
  EXPECT_THAT(found_in(sources), HasSubstr(": near.View.rgba, far.View.rgba; choose one"));
  EXPECT_EQ(chosen("color", "near.View.rgba", sources),
            "color: View.rgba.R View.rgba.G View.rgba.B\n");
  EXPECT_EQ(chosen("color", "far.View.rgba", sources),
            "color: #1:View.rgba.R #1:View.rgba.G #1:View.rgba.B\n");
  EXPECT_THAT(chosen("depth", "", sources),
              HasSubstr(": near.A.Depth.Z, far.A.Depth.Z; choose one"));
  EXPECT_EQ(chosen("depth", "near.A.Depth.Z", sources), "depth: A.Depth.Z\n");
  EXPECT_EQ(chosen("depth", "far.A.Depth.Z", sources), "depth: #1:A.Depth.Z\n");
  EXPECT_THAT(chosen("depth", "mist", sources),
              HasSubstr("there is near.A.Depth (Z), near.View.rgba (R G B), far.A.Depth (Z), "));
}

TEST(LayerSources, HaveTheNamesOfTheParts) {
  ExrPart beauty, depth;
  beauty.name = "beauty";
  beauty.view = "left";
  beauty.channels = {{"G", SampleType::kHalf}, {"R", SampleType::kHalf}};
  depth.channels = {{"Z", SampleType::kFloat}};
  const std::vector<LayerSource> sources = layer_sources(3, "a.exr", std::vector{beauty, depth});
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_EQ(sources[0].file, 3);
  EXPECT_EQ(sources[0].part_name, "beauty");
  EXPECT_EQ(sources[0].view, "left");
  EXPECT_EQ(sources[0].channels, (Names{"G", "R"}));
  EXPECT_EQ(sources[1].part, 1);
  EXPECT_EQ(sources[1].file_name, "a.exr");
}

}  // namespace
}  // namespace limpid

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plate/named_layers.h"

/// Each channel belongs to its view, and the library reads the requested view.

namespace limpid {
namespace {

using test::chosen;
using test::kRgb;
using test::kRgba;
using test::Names;
using test::source;
using test::text_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Sources = std::vector<LayerSource>;

std::string found(const Sources& sources, const std::string& view = "") {
  try {
    return text_of(find_layers(sources, {}, view));
  } catch (const Error& error) {
    return error.what();
  }
}

/// One part with several views, as the attribute multiView lists them.
LayerSource multi_view(const Names& views, const Names& channels) {
  LayerSource one = source(0, "s.exr", channels);
  one.views = views;
  return one;
}

/// The channel names of Nuke and of the OpenEXR test images.
const Sources kParts = {source(0, "s.exr", kRgba, "rgba_right", 0, "right"),
                        source(0, "s.exr", {"Z"}, "depth_left", 1, "left"),
                        source(0, "s.exr", {"mask"}, "whitebarmask_left", 2, "left"),
                        source(0, "s.exr", kRgba, "rgba_left", 3, "left"),
                        source(0, "s.exr", {"Z"}, "depth_right", 4, "right"),
                        source(0, "s.exr", {"Y"}, "shadow", 5)};
const Names kStereoChannels = {
    "B",       "G",       "R",       "Z",      "depth.right.Z", "disparity.x", "left.shadow.Y",
    "right.B", "right.G", "right.R", "right.Z"};

TEST(LayerViews, PartsOfAViewGoTogether) {
  EXPECT_EQ(found(kParts, "left"), "color: #3:R #3:G #3:B #3:A\ndepth: #1:Z\nshadow: #5:Y\n");
  EXPECT_EQ(found(kParts, "right"), "color: R G B A\ndepth: #4:Z\nshadow: #5:Y\n");
  EXPECT_EQ(found(kParts, "RIGHT"), found(kParts, "right"));
  EXPECT_THAT(views_of(kParts), ElementsAre("right", "left"));
}

TEST(LayerViews, TheFirstColorsViewIsTheDefault) {
  EXPECT_EQ(default_view(kParts), "right");
  EXPECT_EQ(found(kParts), found(kParts, "right"));
  EXPECT_EQ(default_view(Sources(kParts.begin() + 1, kParts.end())), "left");
}

TEST(LayerViews, ThePartsNameIsEnough) {
  Sources parts = kParts;
  for (LayerSource& part : parts) part.view.clear();
  EXPECT_EQ(found(parts, "left"), found(kParts, "left"));
  EXPECT_EQ(found(parts), found(kParts));
  EXPECT_THAT(views_of(parts), ElementsAre("right", "left"));
  EXPECT_EQ(
      found({source(0, "s.exr", kRgb, "left.rgba"), source(0, "s.exr", {"Z"}, "leftDepth", 1)},
            "left"),
      "color: R G B\ndepth: #1:Z\n");
}

TEST(LayerViews, ViewsMayHaveAnyName) {
  const Sources parts = {source(0, "s.exr", kRgb, "rgba_cam A", 0, "cam A"),
                         source(0, "s.exr", kRgb, "rgba_cam B", 1, "cam B"),
                         source(0, "s.exr", {"Z"}, "depth_cam B", 2, "cam B")};
  EXPECT_EQ(found(parts, "cam b"), "color: #1:R #1:G #1:B\ndepth: #2:Z\n");
  EXPECT_EQ(found(parts), "color: R G B\n");
  EXPECT_EQ(found({multi_view({"hero", "other"}, {"B", "G", "R", "other.B", "other.G", "other.R"})},
                  "other"),
            "color: other.R other.G other.B\n");
}

TEST(LayerViews, ChannelsWithoutAViewAreThoseOfTheDefaultOne) {
  const Sources stereo = {multi_view({"left", "right"}, kStereoChannels)};
  EXPECT_EQ(default_view(stereo), "left");
  EXPECT_EQ(found(stereo), "color: R G B\ndepth: Z\nshadow: left.shadow.Y\n");
  EXPECT_EQ(found(stereo, "left"), found(stereo));
  // The right view has no shadow, and does not take the left view's shadow.
  EXPECT_EQ(found(stereo, "right"), "color: right.R right.G right.B\ndepth: depth.right.Z\n");
  EXPECT_EQ(found({multi_view({"right", "left"}, {"B", "G", "R", "left.Z"})}), "color: R G B\n");
}

TEST(LayerViews, WithoutTheAttributeTheColorWithoutAViewIsTheDefault) {
  const Sources stereo = {source(0, "s.exr", {"B", "G", "R", "right.B", "right.G", "right.R"})};
  EXPECT_EQ(default_view(stereo), "");
  EXPECT_EQ(found(stereo), "color: R G B\n");
  EXPECT_EQ(found(stereo, "right"), "color: right.R right.G right.B\n");
  EXPECT_EQ(found({source(0, "s.exr", {"ViewLayer.Depth.left.Z", "ViewLayer.Depth.right.Z"})}),
            "depth: ViewLayer.Depth.left.Z\n");
  EXPECT_EQ(found({source(0, "s.exr", {"B", "G", "R", "ViewLayer.Depth.left.Z"})}),
            "color: R G B\ndepth: ViewLayer.Depth.left.Z\n");
}

TEST(LayerViews, TwoChoicesOfOneViewStayAmbiguous) {
  EXPECT_THAT(
      found({source(0, "s.exr", kRgb, "rgba.left", 0, "left"),
             source(0, "s.exr", kRgb, "beauty.left", 1, "left"),
             source(0, "s.exr", kRgb, "rgba.right", 2, "right")}),
      HasSubstr("color: 2 candidates fit equally well: rgba.left, beauty.left; choose one"));
}

TEST(LayerViews, OnlyKnownLayersAreViews) {
  EXPECT_THAT(views_of(Sources{source(0, "s.exr", {"B", "G", "R", "wall left.R", "left wall.R"})}),
              IsEmpty());
  EXPECT_EQ(found({source(0, "s.exr",
                          {"B", "G", "R", "Z", "light_left.B", "light_left.G", "light_left.R"})}),
            "color: R G B\ndepth: Z\n");
}

TEST(LayerViews, ANameThatSeveralViewsHaveMeansThatOfTheOne) {
  const auto chosen_of = [&](const std::string& text, const std::string& view) {
    LayerChoices choices;
    choices["depth"] = choose_layer(role_named("depth"), text, kParts, view);
    return text_of(choices);
  };
  EXPECT_EQ(chosen_of("Z", "left"), "depth: #1:Z\n");
  EXPECT_EQ(chosen_of("Z", ""), "depth: #4:Z\n");
  EXPECT_EQ(chosen_of("depth_left.Z", "right"), "depth: #1:Z\n");
  EXPECT_EQ(chosen_of("depth_left", ""), "depth: #1:Z\n");
  EXPECT_EQ(chosen_of("", "left"), "depth: #1:Z\n");
  EXPECT_EQ(chosen("color", "rgba_left.R,rgba_left.G,rgba_left.B", kParts),
            "color: #3:R #3:G #3:B\n");
  EXPECT_EQ(choose_layer(role_named("color"), "rgba_left", kParts).view, "left");
  EXPECT_EQ(
      chosen("depth", "depht_left.Z", kParts),
      "depth=depht_left.Z: no channel or layer 'depht_left.Z'; there is rgba_right (R G B A), "
      "depth_left (Z), whitebarmask_left (mask), rgba_left (R G B A), depth_right (Z), shadow "
      "(Y); did you mean 'depth_left.Z'?");
}

}  // namespace
}  // namespace limpid

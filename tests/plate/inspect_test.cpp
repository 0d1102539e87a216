#include "limpid/plate/inspect.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limpid {
namespace {

using testing::HasSubstr;

ExrPart part(Size size, const std::vector<std::string>& half_channels,
             const std::vector<std::string>& float_channels) {
  ExrPart p;
  p.data = p.display = rect_of(size);
  p.compression = "zip";
  for (const std::string& name : half_channels) p.channels.push_back({name, SampleType::kHalf});
  for (const std::string& name : float_channels) p.channels.push_back({name, SampleType::kFloat});
  std::sort(p.channels.begin(), p.channels.end(),
            [](const ExrChannel& a, const ExrChannel& b) { return a.name < b.name; });
  return p;
}

std::string inspected(const std::vector<InspectedFile>& files) {
  std::vector<LayerSource> sources;
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (LayerSource& s : layer_sources(static_cast<int>(i), files[i].name, files[i].parts)) {
      sources.push_back(std::move(s));
    }
  }
  return inspect_text(files, find_layers(sources));
}

TEST(Inspect, BlenderMultilayerFile) {
  const std::vector parts = {part(
      {960, 540},
      {"ViewLayer.Combined.A", "ViewLayer.Combined.B", "ViewLayer.Combined.G",
       "ViewLayer.Combined.R", "ViewLayer.Shadow.B", "ViewLayer.Shadow.G", "ViewLayer.Shadow.R"},
      {"ViewLayer.Depth.Z", "ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z"})};
  EXPECT_EQ(inspected({{"dry_multilayer_blender_half_zip.exr", parts}}),
            R"(dry_multilayer_blender_half_zip.exr
  part 0: 960x540, zip, scan lines
    ViewLayer.Combined  R G B A  half
    ViewLayer.Depth     Z        float
    ViewLayer.Normal    X Y Z    float
    ViewLayer.Shadow    R G B    half
found
  color   ViewLayer.Combined.R G B A  (dry_multilayer_blender_half_zip.exr)  - layer 'ViewLayer.Combined' (Blender)
  depth   ViewLayer.Depth.Z           (dry_multilayer_blender_half_zip.exr)  - layer 'ViewLayer.Depth' (Blender, Nuke, Natron)
  shadow  ViewLayer.Shadow.R          (dry_multilayer_blender_half_zip.exr)  - layer 'ViewLayer.Shadow' (Blender)
not found
  reflection        the picture of a flat mirror in the water plane
  surface_depth     depth of the water surface
  surface_normal    world normal of the water surface
  reflection_valid  1 where the reflection is valid, 0 inside of clipped objects
  reflection_depth  depth of the reflection along the mirrored ray
  below_color       the dry scene without the objects above the water
  below_depth       depth of below_color
  surface_shadow    visibility of the sun at the water surface
  sky               the sky without the objects in front of it
  albedo            albedo of the bottom around each pixel
  sun_color         direct sunlight in the dry picture: 0 in shadow
  basin             albedo of an endless floor as bright, over that of the bottom: below 1 by walls and in shade
)");
}

TEST(Inspect, PartsWindowsAndStorage) {
  ExrPart beauty = part({480, 270}, {"A", "B", "G", "R"}, {"Z"});
  beauty.name = "beauty";
  beauty.view = "left";
  beauty.data = {96, 108, 336, 243};
  beauty.tiled = true;
  beauty.pixel_aspect = 2;
  beauty.compression = "dwaa";
  ExrPart deep = part({480, 270}, {"A"}, {"Z", "ZBack"});
  deep.name = "de\x1b[31m\nep";
  deep.deep = true;
  deep.channels.push_back({"chroma.RY", SampleType::kHalf, 2, 2});
  deep.channels.push_back({"id", SampleType::kUint});
  const std::vector parts = {beauty, deep};
  const std::vector shadow = {part({480, 270}, {"Y"}, {})};
  EXPECT_EQ(inspected({{"stereo.exr", parts}, {"reflection_shadow.exr", shadow}}),
            R"(stereo.exr
  part 0 'beauty': data window 240x135 at (96, 108), display window 480x270, dwaa, tiled, pixel aspect 2, view left
    (no layer)  R G B A  half
    (no layer)  Z        float
  part 1 'de?[31m?ep': 480x270, zip, scan lines, deep
    (no layer)  A        half
    (no layer)  Z ZBack  float
    chroma      RY       half, one in 2x2
    (no layer)  id       uint
reflection_shadow.exr
  part 0: 480x270, zip, scan lines
    (no layer)  Y  half
found
  color  R G B A  (stereo.exr, part 0)  - part 'beauty' (Nuke, Arnold, oiiotool)
  depth  Z        (stereo.exr, part 0)  - part 'beauty' (beside the color)
not found
  shadow            visibility of the sun: 1 lit, 0 in shadow
  reflection        the picture of a flat mirror in the water plane
  surface_depth     depth of the water surface
  surface_normal    world normal of the water surface
  reflection_valid  1 where the reflection is valid, 0 inside of clipped objects
  reflection_depth  depth of the reflection along the mirrored ray
  below_color       the dry scene without the objects above the water
  below_depth       depth of below_color
  surface_shadow    visibility of the sun at the water surface
  sky               the sky without the objects in front of it
  albedo            albedo of the bottom around each pixel
  sun_color         direct sunlight in the dry picture: 0 in shadow
  basin             albedo of an endless floor as bright, over that of the bottom: below 1 by walls and in shade
not used
  reflection_shadow.exr
)");
}

TEST(Inspect, ViewsAndPartsThatAreUsed) {
  ExrPart color = part({4, 4}, {"B", "G", "R", "right.B", "right.G", "right.R"}, {});
  color.views = {"left", "right"};
  const ExrPart depth = part({4, 4}, {}, {"Z"});
  const std::vector parts = {color, depth};
  LayerChoices choices;
  choices["color"] = {{{0, 0, "R"}, {0, 0, "G"}, {0, 1, "Z"}}, "named for the buffer", "left"};
  const std::string text = inspect_text(std::vector<InspectedFile>{{"s.exr", parts}}, choices, {},
                                        {{"left", "right"}, "Left"});
  EXPECT_THAT(text, HasSubstr("part 0: 4x4, zip, scan lines, views left right\n"));
  EXPECT_THAT(text, HasSubstr("\nviews\n  left (used), right\nfound\n"
                              "  color  R G Z  (s.exr, parts 0, 1)  - named for the buffer\n"));
  EXPECT_THAT(inspect_text(std::vector<InspectedFile>{{"s.exr", parts}}, {}, {}, {{"right"}, ""}),
              HasSubstr("\nviews\n  default (used), right\n"));
}

TEST(Inspect, ARoleThatCouldNotBeDecidedShowsWhy) {
  const std::vector parts = {part({4, 4}, {"B", "G", "R"}, {})};
  const std::vector<InspectedFile> files = {{"a.exr", parts}};
  EXPECT_THAT(inspect_text(files, {}, {{"color", "color: 2 candidates fit equally well"}}),
              HasSubstr("not found\n  color             color: 2 candidates fit equally well\n"
                        "  depth             depth of the dry scene\n"));
}

}  // namespace
}  // namespace limpid

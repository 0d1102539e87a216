#include <cmath>
#include <map>

#include <gmock/gmock.h>

#include "limpid/files/exr/exr_file.h"

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// --deep: the water as deep samples beside the picture.

namespace limpid::test {
namespace {

using ::testing::HasSubstr;

using Values = std::map<std::string, float>;
using Place = std::pair<int, int>;

/// The samples of a deep file, by pixel; at most one sample per pixel.
std::map<Place, Values> samples_of(const std::filesystem::path& path) {
  const ExrFile file = ExrFile::open(path);
  std::vector<std::string> names;
  for (const ExrChannel& channel : file.parts()[0].channels) names.push_back(channel.name);
  std::map<Place, Values> samples;
  file.read_deep(0, names, [&](const DeepBlock& block) {
    std::size_t pixel = 0;
    for (int y = block.window.y0; y < block.window.y1; ++y) {
      for (int x = block.window.x0; x < block.window.x1; ++x, ++pixel) {
        ASSERT_LE(block.first[pixel + 1] - block.first[pixel], 1u);
        if (block.first[pixel + 1] == block.first[pixel]) continue;
        for (std::size_t c = 0; c < names.size(); ++c) {
          samples[{x, y}][names[c]] = block.values[c][block.first[pixel]];
        }
      }
    }
  });
  return samples;
}

/// The channels of a flat file, by name and pixel.
class Flat {
 public:
  explicit Flat(const std::filesystem::path& path) {
    const ExrFile file = ExrFile::open(path);
    std::vector<ExrRequest> requests;
    for (const ExrChannel& channel : file.parts()[0].channels) {
      Plane& plane = planes_[channel.name] = Plane(file.parts()[0].data);
      requests.push_back({0, channel.name, plane.view()});
    }
    file.read(requests);
  }
  float at(const std::string& channel, const Place& p) {
    return planes_.at(channel).view().at(p.first, p.second);
  }

 private:
  std::map<std::string, Plane> planes_;
};

class DeepOutputTest : public ToolTest {
 protected:
  void composed_deep(const Words& more) const {
    Words words{"--deep", "deep.exr", "--float", "--aov",
                "surface_depth,path,transmittance,in_scatter"};
    words.insert(words.end(), more.begin(), more.end());
    composed("wet.exr", words);
  }
};

constexpr float kEndless = 1e9f;

TEST_F(DeepOutputTest, EveryWetPixelHasTheWaterThatThePictureHas) {
  composed_deep({});
  std::map<Place, Values> samples = samples_of(folder_ / "deep.exr");
  Flat wet(folder_ / "wet.exr");
  int endless = 0;
  for (int y = 0; y < kPicture.height(); ++y) {
    for (int x = 0; x < kPicture.width(); ++x) {
      const Place p{x, y};
      const float front = wet.at("surface_depth.Z", p), path = wet.at("path.Z", p);
      ASSERT_EQ(samples.contains(p), std::isfinite(front)) << x << " " << y;
      if (!samples.contains(p)) continue;
      Values& sample = samples.at(p);
      EXPECT_EQ(sample["Z"], front);
      // The fog of the look is measured in eye depth and is full after 1 / 0.15.
      const bool ends = path < kEndless;
      endless += !ends;
      EXPECT_NEAR(sample["ZBack"], front + (ends ? path : 1 / 0.15f), 1e-5f * (front + path));
      float coverage = 0;
      for (const char c : {'R', 'G', 'B'}) {
        const float alpha = sample[std::string("A") + c];
        EXPECT_EQ(alpha, 1 - wet.at(std::string("transmittance.") + c, p));
        EXPECT_EQ(sample[std::string(1, c)], wet.at(std::string("in_scatter.") + c, p));
        coverage += alpha / 3;
      }
      EXPECT_NEAR(sample["A"], coverage, 1e-6);
    }
  }
  EXPECT_GT(samples.size(), 900u);
  EXPECT_GT(endless, 0);
}

TEST_F(DeepOutputTest, IsADeepExrThatSaysWhereItIsFrom) {
  const Ran ran = composite("wet.exr", {"--deep", "deep.exr", "--compression", "dwaa"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, ::testing::EndsWith("\ndeep.exr\n"));
  const std::string info = iinfo("deep.exr");
  for (const char* fact : {"64 x   36", "deep", "compression: \"zips\"", "limpid/look: \"",
                           "limpid/plan: \"", "limpid/scene: \"", "worldToCamera",
                           "pond/studio: \"shallow end\"", "R (half)", "ZBack (float)"}) {
    EXPECT_THAT(info, HasSubstr(fact));
  }
  // OpenImageIO flattens the file to the same color.
  composed("terms.exr", {"--aov", "in_scatter"});
  ASSERT_EQ(oiiotool({"deep.exr", "--flatten", "--ch", "R,G,B", "-o", "flat.exr"}).code, 0);
  ASSERT_EQ(oiiotool({"terms.exr", "--ch", "R=in_scatter.R,G=in_scatter.G,B=in_scatter.B", "-o",
                      "in_scatter.exr"})
                .code,
            0);
  EXPECT_TRUE(same("flat.exr", "in_scatter.exr", 1e-3));
}

TEST_F(DeepOutputTest, LeavesThePictureAsItIs) {
  composed("plain.exr");
  composed("wet.exr", {"--deep", "deep.exr"});
  EXPECT_EQ(text_of("wet.exr"), text_of("plain.exr"));
}

TEST_F(DeepOutputTest, WaterWithoutEndEndsWhereTheLightDoes) {
  composed_deep({"--set", "depth_fog.model=\"beer_lambert\"", "--set", "depth_fog.distance=\"ray\"",
                 "--set", "depth_fog.absorption=[0.4, 0.2, 0.1]", "--set",
                 "depth_fog.scattering=[0, 0, 0]"});
  std::map<Place, Values> samples = samples_of(folder_ / "deep.exr");
  Flat wet(folder_ / "wet.exr");
  const Rays rays = rays_of(plate_camera(), {kPicture.width(), kPicture.height()});
  int endless = 0;
  for (auto& [place, sample] : samples) {
    const glm::dvec3 ray = rays.ray_at(place.first + 0.5, place.second + 0.5);
    const double length = std::sqrt(ray.x * ray.x + ray.y * ray.y + ray.z * ray.z);
    const double path = wet.at("path.Z", place), thickness = sample["ZBack"] - sample["Z"];
    if (path < kEndless) {
      EXPECT_NEAR(thickness, path / length, 1e-4 * (sample["ZBack"]));
    } else {
      EXPECT_NEAR(thickness, 24 * std::log(2) / 0.1 / length, 1e-3);
      ++endless;
    }
  }
  EXPECT_GT(samples.size(), 900u);
  EXPECT_GT(endless, 0);
}

TEST_F(DeepOutputTest, ClearWaterIsThereButCoversNothing) {
  composed_deep({"--set", "depth_fog.alpha=0"});
  const auto samples = samples_of(folder_ / "deep.exr");
  EXPECT_GT(samples.size(), 900u);
  for (const auto& [place, sample] : samples) EXPECT_EQ(sample.at("A"), 0);
  // A ray without a bottom, in fog without density, has no end.
  composed_deep({"--set", "depth_fog.density=0"});
  const auto ended = samples_of(folder_ / "deep.exr");
  Flat wet(folder_ / "wet.exr");
  EXPECT_LT(ended.size(), samples.size());
  for (const auto& [place, sample] : samples) {
    EXPECT_EQ(ended.contains(place), wet.at("path.Z", place) < kEndless);
  }
}

TEST_F(DeepOutputTest, AViewThatBeginsInTheWaterHasItInFront) {
  const std::string scenes = std::string(LIMPID_DATA) + "/scenes/";
  write_text("deep.toml",
             "[geometry]\ngltf = \"" + scenes + "pool.gltf\"\n[water]\nheight = 100\n");
  const Ran ran = limpid({"water", "deep.toml", "--size", "32x18", "--look", "look.toml", "--set",
                          "depth_fog.distance=\"ray\"", "-o", "wet.%02d.exr", "--deep",
                          "deep.%02d.exr", "--frames", "1-2", "--aov", "path", "-q"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto samples = samples_of(folder_ / "deep.02.exr");
  EXPECT_EQ(samples.size(), 32u * 18u);
  Flat wet(folder_ / "wet.02.exr");
  for (const auto& [place, sample] : samples) {
    EXPECT_EQ(sample.at("Z"), samples.begin()->second.at("Z"));
    const float path = wet.at("path.Z", place);
    if (path > kEndless) continue;
    EXPECT_LT(sample.at("ZBack"), path);  // an eye depth is shorter than the ray
    EXPECT_GT(sample.at("ZBack"), 0.7f * path);
  }
}

TEST_F(DeepOutputTest, RefusesWhatIsNoDeepFile) {
  const Words plate = {"plate.exr", "--scene", "scene.toml"};
  const auto refused = [&](const Words& more, const Words& parts, int code) {
    Words words = plate;
    words.insert(words.end(), more.begin(), more.end());
    expect_no_composite(words, parts, code);
  };
  refused({"--deep", "deep.png"}, {"--deep deep.png", ".exr"}, 2);
  refused({"--deep", "old.exr"}, {"old.exr: is another output, too"}, 2);
  refused({"--deep", "absent/deep.exr"}, {"absent"}, 1);
  const std::string scene = std::string(LIMPID_DATA) + "/scenes/pool.toml";
  const Words water = {"water", scene, "--size", "16x9", "-o", "x.exr", "--deep"};
  const auto refused_water = [&](Words more, const Words& parts) {
    more.insert(more.begin(), water.begin(), water.end());
    expect_refused(limpid(more), parts, 2);
  };
  refused_water({"deep.exr", "--samples", "2"}, {"samples = 2 and a deep file"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "deep.exr"));
}

}  // namespace
}  // namespace limpid::test

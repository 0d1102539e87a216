#include <algorithm>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "limpid/files/text/look_file.h"

#include "paths.h"
#include "tool/tool.h"

/// The looks and presets that are installed with the tool.

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

const fs::path kData(LIMPID_DATA);

std::vector<std::string> names_in(const char* folder) {
  const fs::path folders[] = {kData / folder};
  return look_names(folders);
}

using LooksTest = ToolTest;

TEST_F(LooksTest, ListsEachWithItsSentence) {
  const Ran ran = limpid({"looks"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const std::size_t presets = ran.out.find("\nPresets: ");
  ASSERT_NE(presets, std::string::npos);
  for (const char* folder : {"looks", "presets"}) {
    for (const std::string& name : names_in(folder)) {
      const Look look = load_look(kData / folder / (name + ".toml"));
      EXPECT_FALSE(look.about.empty()) << name;
      const std::size_t at = ran.out.find("\n  " + name + " ");
      ASSERT_NE(at, std::string::npos) << name;
      EXPECT_THAT(ran.out.substr(at + 1, ran.out.find('\n', at + 1) - at), HasSubstr(look.about));
      EXPECT_EQ(at > presets, std::string(folder) == "presets") << name;
    }
  }
  EXPECT_EQ(limpid({"looks", "-q"}).out, ran.out);
}

TEST_F(LooksTest, ShowsEachInAPictureOfThePlate) {
  const Ran ran =
      limpid({"looks", "--pictures", "looks.png", "plate.exr", "--scene", "scene.toml"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("looks.png: 4 by 3 pictures"));
  // Each is half as large as the plate, with four pixels between them.
  EXPECT_THAT(iinfo("looks.png"), ContainsRegex(" [0-9]+ x +[0-9]+, 3 channel, uint8 png"));
  EXPECT_EQ(
      limpid({"looks", "-q", "--pictures", "again.png", "plate.exr", "--scene", "scene.toml"}).out,
      "");
  EXPECT_EQ(text_of("again.png"), text_of("looks.png"));
}

TEST_F(LooksTest, RefusesInASentence) {
  expect_refused(limpid({"looks", "plate.exr"}), {"expected --pictures FILE beside it"}, 2);
  const std::vector<std::vector<std::string>> for_pictures = {
      {"--simd", "scalar"}, {"--runner", "gpu"}, {"--gpu", "H100"}, {"--time", "1"}};
  for (const std::vector<std::string>& option : for_pictures) {
    expect_refused(limpid({"looks", option[0], option[1]}),
                   {"looks " + option[0] + ": is for pictures of the looks"}, 2);
  }
  expect_refused(limpid({"looks", "--pictures", "x.png", "plate.exr", "--scene", "scene.toml",
                         "--view", "left,right"}),
                 {"--view: expected one view, since looks shows one at a time"}, 2);
  expect_refused(limpid({"looks", "--pictures", "looks.exr"}), {"looks.exr"}, 2);
  expect_refused(limpid({"looks", "--pictures", "no/looks.png"}), {"no/looks.png"});
  expect_refused(limpid({"looks", "--pictures", "x.png", "absent.exr"}), {"absent.exr"});
  expect_refused(limpid({"looks", "all"}), {"expected --pictures FILE beside it"}, 2);
  expect_refused(limpid({"composite", "plate.exr", "--scene", "scene.toml", "--look", "harbor",
                         "-o", "o.exr"}),
                 {"no look is named 'harbor'", "did you mean 'harbour'?"});
}

TEST_F(LooksTest, APresetIsAnInputAndSoIsItsBase) {
  fs::create_directories(folder_ / "own");
  write_text("own/calm.toml", "[wave_normals]\nstrength = 0\n");
  write_text("own/calmer.toml", "base = \"calm.toml\"\n[depth_fog]\nsediment = 3\n");
  for (const char* name : {"calm", "calmer"}) {
    fs::create_symlink("own/" + std::string(name) + ".toml",
                       folder_ / (std::string(name) + ".exr"));
    expect_refused(limpid({"composite", "plate.exr", "--scene", "scene.toml", "--look",
                           "own/calmer.toml", "-o", std::string(name) + ".exr"}),
                   {"is an input, too"}, 2);
    fs::remove(folder_ / (std::string(name) + ".exr"));
  }
}

/// A preset causes no warning that the look `physical` does not cause on the same scene.
TEST_F(LooksTest, PresetsWarnOfNothingOfTheirOwnInAnyScene) {
  std::vector<Words> pictures;
  for (const auto& entry : fs::directory_iterator(kData / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    pictures.push_back({"water", entry.path().string(), "--size", "160x90"});
  }
  const std::string lagoon = kData / "plates/lagoon/lagoon.toml";
  pictures.push_back({"composite", "--scene", lagoon});
  Words bare = {"composite", "--scene", lagoon};
  for (const char* role : {"shadow", "reflection", "surface_depth", "surface_normal"}) {
    bare.insert(bare.end(), {"--layer", role + std::string("=none")});
  }
  pictures.push_back(bare);
  ASSERT_GE(pictures.size(), 8u);
  for (Words words : pictures) {
    words.insert(words.end(), {"-q", "-o", "wet.exr", "--look"});
    const auto warnings = [&](const std::string& look) {
      Words all = words;
      all.push_back(look);
      all.erase(std::find(all.begin(), all.end(), "-q"));
      const Ran ran = limpid(all);
      EXPECT_EQ(ran.code, 0) << look << ": " << ran.err;
      return ran.err;
    };
    const std::string before = warnings("physical");
    fs::rename(folder_ / "wet.exr", folder_ / "physical.exr");
    for (const std::string& name : names_in("presets")) {
      EXPECT_EQ(warnings(name), before) << name << ", " << words[1] << " " << words[2];
      EXPECT_FALSE(same("physical.exr", "wet.exr")) << name << ", " << words[1] << " " << words[2];
    }
  }
}

TEST_F(LooksTest, PresetsAreShaders) {
  for (const std::string& name : names_in("presets")) {
    const Ran ran = limpid({"shader", "--look", name});
    EXPECT_EQ(ran.code, 0) << name << ": " << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("LimpidPixel limpid_water(")) << name;
  }
}

}  // namespace
}  // namespace limpid::test

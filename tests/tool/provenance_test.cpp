#include <fstream>
#include <map>

#include <gmock/gmock.h>

#include "limpid/files/exr/exr_file.h"
#include "limpid/files/picture/image_file.h"
#include "limpid/files/text/look_file.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/version.h"

#include "files/content_hash.h"
#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// Each output records its provenance: inputs, options and program.

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

using Texts = std::map<std::string, std::string>;

class ProvenanceTest : public ToolTest {
 protected:
  Texts made(const std::string& name) const {
    if (is_png(name)) return read_image_texts(folder_ / name);
    Texts texts;
    for (const auto& [key, attribute] : ExrFile::open(folder_ / name).attributes(0)) {
      if (!key.starts_with("limpid/")) continue;
      EXPECT_EQ(attribute.type, "string");
      texts[key] = {attribute.bytes.begin(), attribute.bytes.end()};
    }
    return texts;
  }
  std::string scene_hash(const std::string& name) const {
    return made(name).at("limpid/scene_hash");
  }

  /// Runs the tool in a subfolder of the test's folder.
  void run_in(const std::string& inner, Words words) const {
    words.insert(words.begin(), LIMPID_TOOL);
    words.push_back("-q");
    const Ran ran = run(folder_ / inner, words);
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  /// The scene of data/scenes/pool with its files in a folder of its own.
  void copy_pool(const std::string& inner) const {
    fs::create_directories(folder_ / inner);
    for (const auto& entry : fs::directory_iterator(LIMPID_DATA "/scenes")) {
      if (entry.path().filename().string().starts_with("pool")) {
        fs::copy_file(entry.path(), folder_ / inner / entry.path().filename());
      }
    }
  }
};

const Words kNames{"limpid/inputs", "limpid/look",       "limpid/options", "limpid/plan",
                   "limpid/scene",  "limpid/scene_hash", "limpid/version"};

/// The hash by the xxHash project's own program, `xxhsum -H2`.
TEST(ContentHash, IsXxh3Of128Bits) {
  EXPECT_EQ(hash_of(""), "99aa06d3014798d86001c324468d497f");
  const std::string text(1000000, 'a');
  ContentHash hash;
  hash.add(text.data(), 1);
  hash.add(text.data(), text.size() - 1);
  EXPECT_EQ(hash.text(), hash_of(text));
  EXPECT_EQ(hash_of(text), "a545df8e384a9579b1fd6fae5285c4eb");
}

TEST_F(ProvenanceTest, AllFilesOfAFrameSayTheSame) {
  composed("wet.exr", {"--preview", "wet.png", "--deep", "deep.exr", "--time", "2"});
  const Texts texts = made("wet.exr");
  Words names;
  for (const auto& [name, text] : texts) names.push_back(name);
  EXPECT_EQ(names, kNames);
  EXPECT_EQ(made("deep.exr"), texts);
  EXPECT_EQ(made("wet.png"), texts);
  const Ran others = oiiotool({"--info", "-v", "wet.png"});
  EXPECT_THAT(others.out, HasSubstr("limpid/scene_hash: \"" + texts.at("limpid/scene_hash")));

  EXPECT_EQ(texts.at("limpid/version"), kVersion);
  EXPECT_EQ(texts.at("limpid/scene_hash"),
            hash_of(texts.at("limpid/scene") + texts.at("limpid/inputs")));
  EXPECT_EQ(scene_from_toml(texts.at("limpid/scene"), "").scene.time, 2);
  EXPECT_THAT(texts.at("limpid/plan"), ContainsRegex("refraction +kept"));
  EXPECT_THAT(texts.at("limpid/options"), ContainsRegex("simd = \"[a-z0-9]+\""));
  const std::string plate = hash_of_file(folder_ / "plate.exr");
  EXPECT_EQ(texts.at("limpid/inputs"),
            "depth_kind = \"eye\"\n"
            "color = {file = \"" +
                plate +
                "\", part = 0, channels = [\"R\", \"G\", \"B\", \"A\"]}\n"
                "depth = {file = \"" +
                plate +
                "\", part = 0, channels = [\"depth.Z\"]}\n"
                "shadow = {file = \"" +
                plate +
                "\", part = 0, channels = [\"shadow.Y\"]}\n"
                "reflection = {file = \"" +
                plate +
                "\", part = 0, channels = [\"reflection.R\", "
                "\"reflection.G\", \"reflection.B\"]}\n"
                "wave_map = \"" +
                hash_of_file(folder_ / "waves.exr") + "\"\n");
}

TEST_F(ProvenanceTest, TheLookReadsBackAsTheLook) {
  fs::copy_file(LIMPID_DATA "/maps/water_normals.png", folder_ / "water_normals.png");
  const auto made_with = [&](const std::string& look, const std::string& output, Words more = {}) {
    Words words{"composite", "plate.exr", "--scene", "scene.toml", "--look", look, "-o", output};
    words.insert(words.end(), more.begin(), more.end());
    run_in("", words);
    return text_of(output);
  };
  for (const std::string look : {"look.toml", "physical", "rito"}) {
    const std::string bytes =
        made_with(look, "wet.exr", {"--set", "depth_fog.density=0.12345678901"});
    write_text("again.toml", made("wet.exr").at("limpid/look"));
    EXPECT_TRUE(bytes == made_with("again.toml", "again.exr")) << look;
  }
}

TEST_F(ProvenanceTest, TheSameInputsGiveTheSameBytesAnywhere) {
  const fs::path other = folder_ / "another folder" / "deeper";
  fs::create_directories(other);
  fs::copy_file(folder_ / "plate.exr", other / "dry.exr");
  for (const char* name : {"waves.exr", "look.toml"}) fs::copy_file(folder_ / name, other / name);
  fs::copy_file(folder_ / "scene.toml", other / "camera.toml");
  run_in("", {"composite", "plate.exr", "--scene", "scene.toml", "--look", "look.toml", "-o",
              "wet.exr", "--preview", "wet.png", "--deep", "deep.exr", "--threads", "1"});
  run_in("another folder/deeper",
         {"composite", (other / "dry.exr").string(), "--scene", "camera.toml", "--look",
          (other / "look.toml").string(), "-o", "out.exr", "--preview", "out.png", "--deep",
          "out_deep.exr", "--threads", "2"});
  const std::string there = "another folder/deeper/";
  EXPECT_TRUE(text_of("wet.exr") == text_of(there + "out.exr"));
  EXPECT_TRUE(text_of("wet.png") == text_of(there + "out.png"));
  EXPECT_TRUE(text_of("deep.exr") == text_of(there + "out_deep.exr"));
}

/// The wave map's name is the only file name in the provenance, because the look needs the name.
/// Another instruction set gives another provenance.
TEST_F(ProvenanceTest, WhatBytesDoDependOn) {
  composed("wet.exr", {"--simd", "scalar"});
  const std::string bytes = text_of("wet.exr");
  Texts texts = made("wet.exr");
  fs::rename(folder_ / "waves.exr", folder_ / "other.exr");
  composed("wet.exr", {"--simd", "scalar", "--set", "wave_normals.map=other.exr"});
  Texts others = made("wet.exr");
  EXPECT_FALSE(text_of("wet.exr") == bytes);
  EXPECT_THAT(others.at("limpid/look"), HasSubstr("map = \"other.exr\""));
  texts.erase("limpid/look"), others.erase("limpid/look");
  EXPECT_EQ(texts, others);
  fs::rename(folder_ / "other.exr", folder_ / "waves.exr");
  composed("wet.exr");
  EXPECT_NE(made("wet.exr").at("limpid/options"), texts.at("limpid/options"));
}

TEST_F(ProvenanceTest, TheSameModelGivesTheSameBytesAnywhere) {
  copy_pool("a");
  copy_pool("b");
  for (const std::string verb : {"render", "water"}) {
    run_in("a", {verb, "pool.toml", "--size", "32x18", "-o", verb + ".exr", "--threads", "1"});
    run_in("b", {verb, "pool.toml", "--size", "32x18", "-o", "x.exr", "--threads", "2"});
    EXPECT_TRUE(text_of("a/" + verb + ".exr") == text_of("b/x.exr")) << verb;
  }
  const Texts plate = made("a/render.exr"), water = made("a/water.exr");
  EXPECT_EQ(plate.count("limpid/look") + plate.count("limpid/plan"), 0u);
  EXPECT_EQ(water.size(), kNames.size());
  EXPECT_THAT(plate.at("limpid/inputs"), HasSubstr("size = [32, 18]\n"));
  EXPECT_THAT(water.at("limpid/inputs"), HasSubstr("samples = 1\n"));
}

TEST_F(ProvenanceTest, AnotherMaterialIsAnotherModel) {
  const auto rendered = [&](const std::string& inner, const std::string& more) {
    copy_pool(inner);
    std::string gltf = text_of(inner + "/pool.gltf");
    const std::string begin = "\"materials\":[{";
    gltf.replace(gltf.find(begin), begin.size(), begin + more);
    write_text(inner + "/pool.gltf", gltf);
    run_in(inner, {"render", "pool.toml", "--size", "32x18", "-o", "x.exr"});
    return made(inner + "/x.exr").at("limpid/inputs");
  };
  const std::string plain = rendered("plain", "");
  EXPECT_NE(rendered("masked", R"("alphaMode": "MASK", )"), plain);
  EXPECT_NE(rendered("emissive", R"("emissiveFactor": [0, 0, 1], )"), plain);
}

/// The outputs of `truth` have the same provenance as those of `water`, but no plan.
TEST_F(ProvenanceTest, TheTruthSaysHowItWasTraced) {
  copy_pool("a");
  copy_pool("b");
  const auto traced = [&](const std::string& inner, const std::string& name, Words more = {}) {
    Words words{"truth", "pool.toml",   "--size",    "32x18",
                "-o",    name + ".exr", "--preview", name + ".png"};
    words.insert(words.end(), more.begin(), more.end());
    run_in(inner, words);
    return made(inner + "/" + name + ".exr");
  };
  const Texts first = traced("a", "truth", {"--threads", "1"});
  traced("b", "x", {"--threads", "2"});
  EXPECT_TRUE(text_of("a/truth.exr") == text_of("b/x.exr"));
  EXPECT_TRUE(text_of("a/truth.png") == text_of("b/x.png"));
  EXPECT_EQ(made("a/truth.png"), first);
  EXPECT_EQ(first.count("limpid/plan"), 0u);
  EXPECT_EQ(first.size(), kNames.size());
  EXPECT_THAT(first.at("limpid/noise"), ContainsRegex("^0\\.0[0-9]+$"));
  EXPECT_EQ(first.at("limpid/scene_hash"),
            hash_of(first.at("limpid/scene") + first.at("limpid/inputs")));
  EXPECT_THAT(first.at("limpid/inputs"), ContainsRegex("^model = \"[0-9a-f]+\"\nsize = \\[32, 18"));
  EXPECT_EQ(first.at("limpid/options"),
            "runner = \"traced\"\nsamples = 1\nlight = \"paths\"\npaths = 16\nphotons = 0\nseed = "
            "0\naovs = "
            "[]\ncompression = \"piz\"\n"
            "pixels = \"half\"\n");

  const Texts other = traced("a", "other", {"--samples", "2", "--seed", "7", "--aov", "visible"});
  EXPECT_EQ(other.at("limpid/scene_hash"), first.at("limpid/scene_hash"));
  EXPECT_THAT(other.at("limpid/options"),
              HasSubstr("samples = 2\nlight = \"paths\"\npaths = 16\nphotons = 0\nseed = 7\naovs = "
                        "[\"visible\"]\n"));
  std::string bytes = text_of("a/pool.bin");
  bytes[0] ^= 4;  // in the mantissa of a coordinate
  write_text("a/pool.bin", bytes);
  const Texts moved = traced("a", "moved");
  EXPECT_NE(moved.at("limpid/inputs"), first.at("limpid/inputs"));
  EXPECT_NE(moved.at("limpid/scene_hash"), first.at("limpid/scene_hash"));
}

TEST_F(ProvenanceTest, TheSceneHashTellsApartWhatIsToBeSeen) {
  composed("wet.exr");
  std::map<std::string, std::string> seen{{scene_hash("wet.exr"), "as it was"}};
  const auto expect_new = [&](const std::string& what, const Words& more = {}) {
    composed("wet.exr", more);
    const auto [other, is_new] = seen.emplace(scene_hash("wet.exr"), what);
    EXPECT_TRUE(is_new) << what << " is as " << other->second;
  };
  expect_new("time", {"--time", "1"});
  expect_new("layers", {"--layer", "shadow=none"});
  expect_new("other channels", {"--layer", "reflection=R,G,B"});
  expect_new("kind of depth", {"--depth-kind", "ray"});
  expect_new("near and far", {"--depth-kind", "normalised"});
  write_text("scene.toml", scene_toml("near = 0.1\nfar = 200.0\n"));
  expect_new("another far", {"--depth-kind", "normalised"});
  write_text("scene.toml", scene_toml());
  write_plate(folder_ / "plate.exr", {.broken = true});
  expect_new("plate");
  write_plate(folder_ / "plate.exr");
  composed("wet.exr");
  EXPECT_EQ(seen.at(scene_hash("wet.exr")), "as it was");
  fs::copy_file(LIMPID_DATA "/maps/water_normals.png", folder_ / "waves.png");
  expect_new("wave map", {"--set", "wave_normals.map=waves.png"});

  // Look and options are recorded as text, not as a hash.
  const Texts before = [&] {
    composed("wet.exr");
    return made("wet.exr");
  }();
  composed("wet.exr", {"--set", "depth_fog.density=0.7", "--float", "--simd", "scalar"});
  Texts after = made("wet.exr");
  EXPECT_EQ(after.at("limpid/scene_hash"), before.at("limpid/scene_hash"));
  EXPECT_NE(after.at("limpid/look"), before.at("limpid/look"));
  EXPECT_THAT(after.at("limpid/options"), HasSubstr("simd = \"scalar\"\n"));
  EXPECT_THAT(after.at("limpid/options"), HasSubstr("pixels = \"float\"\n"));
}

TEST_F(ProvenanceTest, TheSceneHashTellsModelsApart) {
  copy_pool("a");
  std::map<std::string, std::string> seen;
  const auto expect_new = [&](const std::string& what, Words more = {"--size", "32x18"}) {
    Words words{"water", "pool.toml", "-o", "wet.exr"};
    words.insert(words.end(), more.begin(), more.end());
    run_in("a", words);
    const auto [other, is_new] = seen.emplace(scene_hash("a/wet.exr"), what);
    EXPECT_TRUE(is_new) << what << " is as " << other->second;
  };
  expect_new("as it was");
  expect_new("size", {"--size", "34x18"});
  expect_new("overscan", {"--size", "32x18", "--overscan", "2"});
  expect_new("shadow map", {"--size", "32x18", "--shadow-map", "512"});
  expect_new("samples", {"--size", "32x18", "--samples", "2"});
  std::string bytes = text_of("a/pool.bin");
  bytes[0] ^= 4;  // in the mantissa of a coordinate
  write_text("a/pool.bin", bytes);
  expect_new("a vertex");
  fs::copy_file(folder_ / "a/pool_wall.png", folder_ / "a/pool_tile.png",
                fs::copy_options::overwrite_existing);
  expect_new("a texture");
}

TEST_F(ProvenanceTest, InspectShowsIt) {
  composed("wet.exr", {"--preview", "wet.png"});
  for (const std::string name : {"wet.exr", "wet.png"}) {
    const Ran ran = limpid({"inspect", name});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("how " + name + " was made\n  limpid/inputs\n    depth_kind"));
    EXPECT_THAT(ran.out, HasSubstr("\n  limpid/scene_hash  " + scene_hash("wet.exr") + "\n"));
    EXPECT_THAT(ran.out, ContainsRegex("\n  limpid/plan\n    wave_normals +kept"));
    EXPECT_THAT(ran.out, HasSubstr("\n    [refraction]\n"));
  }
}

}  // namespace
}  // namespace limpid::test

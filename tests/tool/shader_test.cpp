#include <cstdint>
#include <cstring>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "tool/tool.h"

/// The verb shader: looks as shaders in other languages.

namespace limpid::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using ShaderTest = ToolTest;

TEST_F(ShaderTest, EveryLanguageHasTheFunctionAndItsMaps) {
  const struct {
    const char *name, *main, *begins, *has;
  } kCases[] = {{"glsl", "none", "#version 450\n", "LimpidPixel water(ivec2 pixel)"},
                {"glsl", "compute", "#version 450\n", "imageStore(limpid_out_color, "},
                {"glsl-es", "fragment", "#version 300 es\n", "LimpidPixel water(ivec2 pixel)"},
                {"glsl-es", "compute", "#version 310 es\n", "std140) uniform LimpidNumbers"},
                {"hlsl", "compute", "", "LimpidPixel water(int2 pixel)"},
                {"msl", "fragment", "#include <metal_stdlib>", "LimpidPixel water("}};
  for (const auto& test : kCases) {
    const Ran ran = limpid({"shader", "--look", "realistic", "--planes", "shadow", "--lang",
                            test.name, "--main", test.main, "--function", "water", "-o", "a.txt"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, StartsWith(std::string("a.txt: ") + test.name + ", "));
    const std::string text = text_of("a.txt");
    EXPECT_THAT(text, HasSubstr(test.begins)) << test.name;
    EXPECT_THAT(text, HasSubstr(test.has)) << test.name;
    EXPECT_THAT(text, HasSubstr("refraction_strength"))
        << test.name << ": numbers keep their names";
  }
  const auto json = nlohmann::json::parse(text_of("a.txt.json"));
  EXPECT_EQ(json["function"], "water");
  bool found = false;
  for (const auto& number : json["block"]["numbers"]) {
    if (number["name"] != "refraction.strength") continue;
    found = true;
    EXPECT_TRUE(number.contains("range"));
  }
  EXPECT_TRUE(found);
  std::vector<std::string> roles;
  for (const auto& texture : json["textures"]) {
    if (texture.contains("role")) roles.push_back(texture["role"]);
  }
  EXPECT_THAT(roles, testing::ElementsAre("color", "depth", "shadow"));
  EXPECT_THAT(iinfo("a.txt.limpid_wave_map.exr"), HasSubstr("256 x  256, 3 channel, float"));
}

TEST_F(ShaderTest, SpirvIsWordsOfAModule) {
  ASSERT_EQ(limpid({"shader", "--look", "rito", "--lang", "spirv", "--main", "compute",
                    "--descriptor-set", "3", "--first-binding", "7", "-q", "-o", "a.spv"})
                .code,
            0);
  const std::string bytes = text_of("a.spv");
  ASSERT_EQ(bytes.size() % 4, 0u);
  std::uint32_t magic = 0;
  std::memcpy(&magic, bytes.data(), 4);
  EXPECT_EQ(magic, 0x07230203u);
}

/// The Khronos group's compiler accepts the texts, and its validator accepts the SPIR-V.
TEST_F(ShaderTest, OtherPeoplesCompilersTakeEveryLook) {
  const auto expect_taken = [&](const Words& command, const std::string& what) {
    const Ran ran = run(folder_, command);
    EXPECT_EQ(ran.code, 0) << what << ": " << ran.out << ran.err;
  };
  for (const std::string look : {"physical", "fast", "realistic", "monogame", "rito"}) {
    for (const std::string main : {"compute", "fragment"}) {
      const auto write = [&](const std::string& language, const std::string& file) {
        const Ran ran = limpid({"shader", "--look", look, "--planes", "shadow,reflection", "--lang",
                                language, "--main", main, "-q", "-o", file});
        ASSERT_EQ(ran.code, 0) << ran.err;
      };
      const std::string stage = main.substr(0, 4), what = look + " " + main;
      write("hlsl", "a.hlsl");
      expect_taken({GLSLANG, "-D", "-V", "-S", stage, "-e", "main", "a.hlsl", "-o", "a.hlsl.spv"},
                   what + " in HLSL");
      write("glsl-es", "a." + stage);
      expect_taken({GLSLANG, "a." + stage}, what + " in GLSL ES");
      write("spirv", "a.spv");
      expect_taken({SPIRV_VAL, "--target-env", "vulkan1.0", "a.spv"}, what + " in SPIR-V");
    }
  }
}

TEST_F(ShaderTest, PrintsTheTextWithoutAFile) {
  const Ran ran = limpid({"shader", "--look", "monogame"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, StartsWith("#version 450\n// Water, by limpid: wave_normals"));
}

TEST_F(ShaderTest, RefusesInASentence) {
  expect_refused(limpid({"shader", "--look", "nix"}), {"no look is named 'nix'"});
  expect_refused(limpid({"shader", "--lang", "hsl"}),
                 {"'hsl' is not a shader language", "did you mean 'hlsl'?"}, 2);
  expect_refused(limpid({"shader", "--planes", "shade"}), {"'shade' is not a buffer"}, 2);
  expect_refused(limpid({"shader", "--main", "vertex"}), {"expected none, compute or fragment"}, 2);
  expect_refused(limpid({"shader", "--function", "a b"}), {"'a b' is not a function name"}, 2);
  expect_refused(limpid({"shader", "--descriptor-set", "32"}), {"--descriptor-set"}, 2);
  expect_refused(limpid({"shader", "--aov", "sky"}), {"the AOV sky shows a buffer"}, 2);
  expect_refused(limpid({"shader", "--lang", "spirv"}), {"spirv is binary: expected -o FILE"}, 2);
  expect_refused(limpid({"shader", "-o", "absent/a.glsl"}), {"absent"});
}

}  // namespace
}  // namespace limpid::test

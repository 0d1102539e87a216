#include "limpid/shade/shader_text.h"

#include <algorithm>
#include <cstring>
#include <set>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "ops/contract.h"
#include "shade/bundled.h"

/// The text of a shader and the values beside the text. Other tests run the text and compare its
/// results.

namespace limpid {
namespace {

using Stage = ShaderOptions::Stage;

ShaderText text_of(const Look& look, const test::World& world, const ShaderOptions& options = {}) {
  const Frame& frame = world.buffers.frame;
  return {make_plan(look, test::inputs_of(frame, world.scene)), frame, world.scene, options};
}

/// Another frame of the same kind: size, camera, time, sun, all numbers.
struct OtherWorld : test::World {
  OtherWorld() : test::World(false), other(test::noisy_frame({-3, 2, 90, 60})) {
    scene = test::simple_scene({93, 58});
    scene.time = 0;
    scene.camera->view[3] += glm::dvec4(0.3, -0.7, 2, 0);
    scene.sun->color = {0.7, 0.8, 0.9};
    Frame& to = buffers.frame;
    to.planes = other.frame.planes;
    to.display = other.frame.display;
    for (int c = 0; c < 3; ++c) to.planes[index_of(PlaneId::kSurfaceNormalX) + c] = {};
  }
  test::Buffers other;
};

TEST(ShaderText, IsTheSameForAnySizeTimeAndPlace) {
  const test::World here(false);
  const OtherWorld there;
  for (const char* name : test::kShippedLooks) {
    const ShaderText a = text_of(test::shipped_look(name), here),
                     b = text_of(test::shipped_look(name), there);
    EXPECT_EQ(a.id(), b.id()) << name;
    EXPECT_EQ(a.text(), b.text()) << name;
    EXPECT_NE(a.block(), b.block()) << name;
    EXPECT_EQ(a.block().size(), b.block().size()) << name;
  }
}

/// A parameter above 0 is a number of the block, by its name: another value above 0 changes the
/// number and not the text.
TEST(ShaderText, HasParametersAsNumbers) {
  const test::World world(false);
  Look look = test::shipped_look("realistic");
  const ShaderText before = text_of(look, world);
  const double strength = 0.5 * look.of<Refraction>().strength;
  look.set("refraction", "strength", strength);
  look.set("depth_fog", "color", Rgb<double>{0.11, 0.12, 0.13});
  const ShaderText after = text_of(look, world);
  EXPECT_EQ(before.text(), after.text());
  const auto find = [](const ShaderText& text, const std::string& name) {
    const auto& all = text.numbers();
    const auto at = std::find_if(all.begin(), all.end(),
                                 [&](const ShaderNumber& number) { return number.name == name; });
    return at == all.end() ? ShaderNumber{} : *at;
  };
  const ShaderNumber number = find(after, "refraction.strength");
  EXPECT_EQ(number.value, static_cast<float>(strength));
  ASSERT_TRUE(number.range.has_value());
  float in_block = 0;
  std::memcpy(&in_block, after.block().data() + number.offset, sizeof in_block);
  EXPECT_EQ(in_block, number.value);
  EXPECT_EQ(find(after, "depth_fog.color.g").value, 0.12f);
  EXPECT_NE(after.text().find("float refraction_strength;"), std::string::npos);
  EXPECT_NE(find(after, "water.up[1]").value, 0);
  EXPECT_FALSE(find(after, "water.up[1]").range.has_value());
}

TEST(ShaderText, DeclaresEachNameAndPlaceOnce) {
  const test::World world(false);
  const ShaderText text = text_of(
      test::shipped_look("physical"), world,
      {.stage = Stage::kCompute, .set = 2, .first_binding = 5, .aovs = {Aov::kPath, Aov::kNormal}});
  EXPECT_EQ(text.block_binding(), 5);
  std::set<int> places{text.block_binding()};
  for (const ShaderOutput& output : text.outputs())
    EXPECT_TRUE(places.insert(output.binding).second);
  std::set<std::string> names;
  for (const ShaderTexture& texture : text.textures()) {
    EXPECT_TRUE(places.insert(texture.binding).second) << texture.name;
    EXPECT_TRUE(names.insert(texture.name).second);
    const std::string declared = "layout(set = 2, binding = " + std::to_string(texture.binding) +
                                 ") uniform sampler2D " + texture.name + ";";
    EXPECT_NE(text.text().find(declared), std::string::npos) << declared;
    if (texture.source == ShaderTexture::Source::kPlanes) continue;
    EXPECT_EQ(texture.texels.size(),
              static_cast<std::size_t>(texture.channels) * texture.width * texture.height)
        << texture.name;
  }
  EXPECT_EQ(*places.begin(), 5);
  EXPECT_EQ(*places.rbegin(), 4 + static_cast<int>(places.size()));
  std::set<std::string> numbers;
  std::size_t last = 0;
  for (const ShaderNumber& number : text.numbers()) {
    EXPECT_TRUE(numbers.insert(number.name).second) << number.name;
    EXPECT_GT(number.offset, last);
    last = number.offset;
  }
  EXPECT_LE(last + 4, text.block().size());
  EXPECT_EQ(text.block().size() % 16, 0u);
}

/// A shader computes only what its look needs.
TEST(ShaderText, ReadsOnlyWhatTheLookNeeds) {
  const test::World world(false);
  Look calm = test::still_look();
  const ShaderText text = text_of(calm, world);
  for (const ShaderTexture& texture : text.textures()) {
    EXPECT_NE(texture.role, "shadow");
    EXPECT_NE(texture.role, "albedo");
  }
  EXPECT_LT(text.text().size(), text_of(test::shipped_look("physical"), world).text().size() / 4);
}

TEST(ShaderText, LongProgramsHaveLargeGroupsWhereTheDeviceHasThem) {
  const test::World world(false);
  const auto group_of = [&](const char* look, int max_threads) {
    ShaderOptions options{.stage = Stage::kCompute};
    options.max_threads = max_threads;
    const ShaderText made = text_of(test::shipped_look(look), world, options);
    EXPECT_NE(made.text().find("local_size_x = " + std::to_string(made.group().width) +
                               ", local_size_y = " + std::to_string(made.group().height)),
              std::string::npos);
    return made.group();
  };
  EXPECT_EQ(group_of("physical", 1024), (Size{16, 64}));
  EXPECT_EQ(group_of("physical", 1023), (Size{16, 16}));
  EXPECT_EQ(group_of("physical", 255), (Size{16, 8}));
  EXPECT_EQ(group_of("realistic", 1024), (Size{16, 8}));
}

TEST(ShaderText, RefusesWhatItCannotPrint) {
  const test::World world(false);
  const auto refusal = [&](const ShaderOptions& options) -> std::string {
    try {
      text_of(test::still_look(), world, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({.function = "2d"}),
            "'2d' is not a function name: expected letters, digits and _");
  EXPECT_EQ(refusal({.function = "gl_water"}),
            "'gl_water' is not a function name: expected letters, digits and _");
  EXPECT_EQ(refusal({.function = "a__b"}),
            "'a__b' is not a function name: expected letters, digits and _");
  EXPECT_EQ(refusal({.set = 32}), "descriptor set 32 is out of 0 ... 31");
  EXPECT_EQ(refusal({.first_binding = -1}), "first binding -1 is out of 0 ... 1000");
  EXPECT_EQ(refusal({.max_threads = 127}), "max_threads = 127: expected 128 at least");
  EXPECT_EQ(refusal({.aovs = {Aov::kSky}}),
            "the AOV sky shows a buffer of the frame: a shader has none to make");
}

}  // namespace
}  // namespace limpid

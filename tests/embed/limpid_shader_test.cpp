#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "limpid/limpid.h"
#include "limpid/shade/shader_text.h"

#include "embed/limpid_c.h"

/// A look as a shader, through the C functions.

namespace limpid {
namespace {

using test::c::channel;
using test::c::kSize;
using test::c::LimpidC;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// limpid_shader and its text, through the C functions.
class LimpidCShader : public LimpidC {
 protected:
  LimpidCShader() { options.first_binding = 3; }
  ~LimpidCShader() override { limpid_destroy_shader(shader); }

  /// The library's shader of the same frame.
  ShaderText expected_text(const ShaderOptions& wanted) {
    Scene scene = test::simple_scene(kSize);
    scene.sun->direction = glm::normalize(3.0 * scene.sun->direction);
    const Plan plan =
        make_plan({}, test::inputs_of(buffers.frame, scene), state_shown_by(wanted.aovs));
    return ShaderText(plan, buffers.frame, scene, wanted);
  }
  void expect_no_shader(const char* why) {
    limpid_destroy_shader(shader);
    shader = reinterpret_cast<limpid_shader*>(this);  // the call overwrites this value
    EXPECT_EQ(limpid_create_shader(water, &frame, &options, &shader), LIMPID_REFUSED);
    EXPECT_EQ(shader, nullptr);
    EXPECT_THAT(limpid_message(water), HasSubstr(why));
  }
  bool make() { return limpid_create_shader(water, &frame, &options, &shader) == LIMPID_OK; }

  limpid_shader* shader = nullptr;
  limpid_shader_options options = LIMPID_SHADER_OPTIONS;
};

TEST_F(LimpidCShader, HasTheTextAndTheBlockOfShaderText) {
  const int32_t aovs[] = {LIMPID_OUT_PATH, LIMPID_OUT_NORMAL};
  options.stage = LIMPID_SHADER_COMPUTE;
  options.function = "wet";
  options.set = 2;
  options.aovs = aovs;
  options.aov_count = 2;
  ASSERT_TRUE(make()) << limpid_message(water);
  const ShaderText expected = expected_text({.stage = ShaderOptions::Stage::kCompute,
                                             .function = "wet",
                                             .set = 2,
                                             .first_binding = 3,
                                             .aovs = {Aov::kPath, Aov::kNormal}});
  limpid_shader_info info = LIMPID_SHADER_INFO;
  ASSERT_EQ(limpid_get_shader(shader, &info), LIMPID_OK) << limpid_shader_message(shader);
  EXPECT_EQ(info.size, sizeof info);
  EXPECT_EQ(info.text, expected.text());
  EXPECT_EQ(info.id, expected.id());
  EXPECT_STREQ(info.function, "wet");
  EXPECT_EQ(info.stage, LIMPID_SHADER_COMPUTE);
  EXPECT_EQ(info.set, 2);
  EXPECT_EQ(info.block_binding, 3);
  const auto* bytes = static_cast<const std::byte*>(info.block);
  EXPECT_EQ(std::vector<std::byte>(bytes, bytes + info.block_size), expected.block());
  EXPECT_EQ((Rect{info.x0, info.y0, info.x1, info.y1}), expected.work());

  ASSERT_EQ(info.number_count, expected.numbers().size());
  int ranges = 0;
  for (size_t i = 0; i < info.number_count; ++i) {
    limpid_shader_number number = LIMPID_SHADER_NUMBER;
    ASSERT_EQ(limpid_get_shader_number(shader, i, &number), LIMPID_OK);
    const ShaderNumber& other = expected.numbers()[i];
    EXPECT_EQ(number.name, other.name);
    EXPECT_EQ(number.offset, other.offset);
    EXPECT_EQ(number.value, other.value);
    ASSERT_EQ(number.has_range != 0, other.range.has_value());
    if (!other.range) continue;
    ++ranges;
    EXPECT_EQ(number.least, other.range->min);
    EXPECT_EQ(number.most, other.range->max);
  }
  EXPECT_GE(ranges, 3);

  ASSERT_EQ(info.texture_count, expected.textures().size());
  for (size_t i = 0; i < info.texture_count; ++i) {
    limpid_shader_texture texture = LIMPID_SHADER_TEXTURE;
    ASSERT_EQ(limpid_get_shader_texture(shader, i, &texture), LIMPID_OK);
    const ShaderTexture& other = expected.textures()[i];
    EXPECT_EQ(texture.name, other.name);
    EXPECT_EQ(texture.binding, other.binding);
    EXPECT_EQ(texture.source, static_cast<int32_t>(other.source));
    EXPECT_EQ(texture.role, other.role);
    EXPECT_EQ(texture.plane, other.role.empty() ? -1 : index_of(role_named(other.role).first));
    EXPECT_EQ(texture.channels, other.channels);
    EXPECT_EQ(texture.width, other.width);
    EXPECT_EQ(texture.height, other.height);
    ASSERT_EQ(texture.texels == nullptr, texture.source == LIMPID_TEXTURE_PLANES);
    if (!texture.texels) continue;
    EXPECT_EQ(std::vector<float>(texture.texels, texture.texels + other.texels.size()),
              other.texels);
  }

  ASSERT_EQ(info.output_count, 3u);
  for (size_t i = 0; i < info.output_count; ++i) {
    limpid_shader_output output = LIMPID_SHADER_OUTPUT;
    ASSERT_EQ(limpid_get_shader_output(shader, i, &output), LIMPID_OK);
    EXPECT_EQ(output.name, expected.outputs()[i].name);
    EXPECT_EQ(output.channels, expected.outputs()[i].channels);
    EXPECT_EQ(output.binding, expected.outputs()[i].binding);
  }
}

/// A shader owns its memory, and runs of the compositor do not change the shader.
TEST_F(LimpidCShader, OutlivesItsCompositorAndLeavesRunsAlone) {
  ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK);
  const std::vector<float> picture_before = out.values();
  std::string plan(limpid_plan_text(water, nullptr, 0) + 1, ' ');
  limpid_plan_text(water, plan.data(), plan.size());
  frame.time = 7;
  ASSERT_EQ(limpid_create_shader(water, &frame, nullptr, &shader), LIMPID_OK);
  EXPECT_EQ(out.values(), picture_before);
  std::string plan_after(limpid_plan_text(water, nullptr, 0) + 1, ' ');
  limpid_plan_text(water, plan_after.data(), plan_after.size());
  EXPECT_EQ(plan_after, plan);
  frame.time = 0;
  ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK);
  EXPECT_EQ(out.values(), picture_before);
  limpid_destroy(water);
  water = nullptr;
  limpid_shader_info info = LIMPID_SHADER_INFO;
  ASSERT_EQ(limpid_get_shader(shader, &info), LIMPID_OK);
  EXPECT_STREQ(info.function, "limpid_water");
  EXPECT_EQ(info.block_binding, 0);
  EXPECT_EQ(info.text, expected_text({}).text());
}

/// Parameters that are set are in the block, and the text stays.
TEST_F(LimpidCShader, FollowsTheLook) {
  ASSERT_TRUE(make());
  ASSERT_EQ(limpid_set_number(water, "water_shadow", "strength", 0.5), LIMPID_OK);
  limpid_shader* other = nullptr;
  ASSERT_EQ(limpid_create_shader(water, &frame, &options, &other), LIMPID_OK);
  limpid_shader_info before = LIMPID_SHADER_INFO, after = LIMPID_SHADER_INFO;
  limpid_get_shader(shader, &before);
  limpid_get_shader(other, &after);
  EXPECT_STREQ(before.id, after.id);
  ASSERT_EQ(before.block_size, after.block_size);
  EXPECT_NE(std::memcmp(before.block, after.block, before.block_size), 0);
  limpid_destroy_shader(other);
}

TEST_F(LimpidCShader, RefusesWhatIsNone) {
  options.stage = 3;
  expect_no_shader("limpid_shader_options.stage = 3: expected 0 ... 2");
  options.stage = 0;
  options.function = "2d";
  expect_no_shader("'2d' is not a function name");
  options.function = nullptr;
  options.set = -1;
  expect_no_shader("descriptor set -1 is out of 0 ... 31");
  options.set = 0;
  options.first_binding = 1001;
  expect_no_shader("first binding 1001");
  options.first_binding = 0;
  options.aov_count = 2;
  expect_no_shader("limpid_shader_options.aovs is NULL");
  int32_t aovs[2] = {LIMPID_OUT_PATH, LIMPID_OUT_PATH};
  options.aovs = aovs;
  expect_no_shader("limpid_shader_options.aovs[1] = 22: it is given twice");
  for (const int32_t none : {LIMPID_OUT_PATH + 1, int32_t{LIMPID_OUT_R}, LIMPID_OUT_SKY + 3, -2}) {
    aovs[1] = none;
    expect_no_shader("expected the first channel of an AOV");
  }
  aovs[1] = LIMPID_OUT_SKY;
  expect_no_shader("the AOV sky shows a buffer of the frame");
  options.aov_count = 0;
  options.size = sizeof options + 4;
  expect_no_shader("limpid_shader_options.size");
  options.size = sizeof options;
  frame.time = NAN;
  expect_no_shader("time");
  frame.time = 0;
  frame.width = 0;
  expect_no_shader("display window is empty");
  frame.width = kSize.width;
  frame.plane_count = 4;
  expect_no_shader("depth");
  frame.plane_count = planes.size();
  EXPECT_EQ(limpid_create_shader(water, nullptr, &options, &shader), LIMPID_REFUSED);
  EXPECT_EQ(limpid_create_shader(nullptr, &frame, &options, &shader), LIMPID_REFUSED);
  EXPECT_EQ(limpid_create_shader(water, &frame, &options, nullptr), LIMPID_REFUSED);
  EXPECT_TRUE(make()) << limpid_message(water);
}

/// Without `trusted` a frame may hold NaN: the shader does not depend on replaced values.
TEST_F(LimpidCShader, TakesFramesWithNan) {
  limpid_destroy(water);
  ASSERT_EQ(limpid_create(nullptr, nullptr, &water, nullptr, 0), LIMPID_OK);
  buffers.set(PlaneId::kColorB, [](int x, int) { return x == 3 ? NAN : 0.5f; });
  planes[2] = channel(2, buffers.frame.planes[2]);
  ASSERT_TRUE(make()) << limpid_message(water);
  limpid_shader_info info = LIMPID_SHADER_INFO;
  limpid_get_shader(shader, &info);
  EXPECT_EQ(info.text, expected_text({.first_binding = 3}).text());
  for (size_t i = 0; i < info.number_count; ++i) {
    limpid_shader_number number = LIMPID_SHADER_NUMBER;
    limpid_get_shader_number(shader, i, &number);
    EXPECT_FALSE(std::isnan(number.value)) << number.name;
  }
}

TEST_F(LimpidCShader, FillsAsMuchAsTheCallerKnows) {
  EXPECT_STREQ(limpid_shader_message(nullptr), "shader is NULL");
  limpid_destroy_shader(nullptr);
  ASSERT_TRUE(make());
  EXPECT_STREQ(limpid_shader_message(shader), "");
  limpid_shader_number number = LIMPID_SHADER_NUMBER;
  number.value = -7;
  number.size = offsetof(limpid_shader_number, value);
  ASSERT_EQ(limpid_get_shader_number(shader, 0, &number), LIMPID_OK);
  EXPECT_EQ(number.name, expected_text({.first_binding = 3}).numbers()[0].name);
  EXPECT_EQ(number.size, offsetof(limpid_shader_number, value));
  EXPECT_EQ(number.value, -7);
  number.size = sizeof number + 8;
  EXPECT_EQ(limpid_get_shader_number(shader, 0, &number), LIMPID_REFUSED);
  EXPECT_THAT(limpid_shader_message(shader), StartsWith("limpid_shader_number.size"));
  number.size = 0;
  EXPECT_EQ(limpid_get_shader_number(shader, 0, &number), LIMPID_REFUSED);

  limpid_shader_info info = LIMPID_SHADER_INFO;
  ASSERT_EQ(limpid_get_shader(shader, &info), LIMPID_OK);
  number.size = sizeof number;
  EXPECT_EQ(limpid_get_shader_number(shader, info.number_count, &number), LIMPID_REFUSED);
  EXPECT_EQ(number.value, -7);
  EXPECT_EQ(limpid_shader_message(shader), "number " + std::to_string(info.number_count) +
                                               " of a shader that has " +
                                               std::to_string(info.number_count));
  limpid_shader_texture texture = LIMPID_SHADER_TEXTURE;
  EXPECT_EQ(limpid_get_shader_texture(shader, info.texture_count, &texture), LIMPID_REFUSED);
  limpid_shader_output output = LIMPID_SHADER_OUTPUT;
  EXPECT_EQ(limpid_get_shader_output(shader, 1, &output), LIMPID_REFUSED);
  EXPECT_THAT(limpid_shader_message(shader), StartsWith("output 1 of a shader that has 1"));
  EXPECT_EQ(limpid_get_shader(shader, nullptr), LIMPID_REFUSED);
  EXPECT_EQ(limpid_get_shader_number(shader, 0, nullptr), LIMPID_REFUSED);
  EXPECT_EQ(limpid_get_shader_texture(shader, 0, nullptr), LIMPID_REFUSED);
  EXPECT_EQ(limpid_get_shader_output(shader, 0, nullptr), LIMPID_REFUSED);
  EXPECT_THAT(limpid_shader_message(shader), StartsWith("limpid_shader_output is NULL"));
  EXPECT_EQ(limpid_get_shader(nullptr, &info), LIMPID_REFUSED);
}

}  // namespace
}  // namespace limpid

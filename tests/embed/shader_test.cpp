#include <gtest/gtest.h>

#include "limpid/compositor.h"
#include "limpid/core/error.h"

#include "embed/host.h"
#include "embed/subject.h"

/// A compositor's look as a shader: that of ShaderText for the frame as it is entered.

namespace limpid {
namespace {

using test::busy_look;
using test::Subject;

ShaderText expected_of(const Look& look, const Frame& frame, const Scene& scene,
                       const ShaderOptions& options = {}) {
  const Plan plan = make_plan(look, test::inputs_of(frame, scene), state_shown_by(options.aovs));
  return ShaderText(plan, frame, scene, options);
}

void expect_same(const ShaderText& a, const ShaderText& b) {
  EXPECT_EQ(a.text(), b.text());
  EXPECT_EQ(a.block(), b.block());
  EXPECT_EQ(a.work(), b.work());
  ASSERT_EQ(a.textures().size(), b.textures().size());
  for (std::size_t i = 0; i < a.textures().size(); ++i) {
    EXPECT_EQ(a.textures()[i].source, b.textures()[i].source) << a.textures()[i].name;
    EXPECT_EQ(a.textures()[i].texels, b.textures()[i].texels) << a.textures()[i].name;
  }
}

TEST(CompositorShader, IsThatOfTheFrameAsItIsEntered) {
  const Subject s;
  const ShaderOptions options{.set = 1, .aovs = {Aov::kPath}};
  const ShaderText expected = expected_of(busy_look(), s.buffers.frame, s.scene, options);
  HostFrame frame = test::host_frame(s.buffers.frame, s.scene);
  Compositor trusted({.trusted = true}, busy_look()), careful({}, busy_look());
  expect_same(trusted.shader(frame, options), expected);
  expect_same(careful.shader(frame, options), expected);

  const glm::dmat4 view = frame.scene.camera->view, projection = frame.scene.camera->projection;
  const glm::dmat4 turned = glm::scale(glm::dmat4(1), {1, 1, -1});
  const glm::dmat4 down = glm::scale(glm::dmat4(1), {1, -1, 1});
  Compositor other({.looks_along_plus_z = true, .clip_y_down = true, .trusted = true}, busy_look());
  frame.scene.camera->view = turned * view;
  frame.scene.camera->projection = down * projection * turned;
  expect_same(other.shader(frame, options), expected);
}

TEST(CompositorShader, HasTheMapsOfTheHost) {
  Subject s;
  Look look = busy_look();
  look.of<WaveNormals>().model = WaveNormals::Model::kFourMaps;
  for (int c = 0; c < 3; ++c) s.buffers.frame.planes[index_of(PlaneId::kSurfaceNormalX) + c] = {};
  const test::NoiseMap map(16, 8), sky(12, 6);
  Compositor compositor({.trusted = true}, look);
  compositor.set_wave_map(map.texture);
  compositor.set_environment(sky.texture);
  const ShaderText made = compositor.shader(test::host_frame(s.buffers.frame, s.scene));
  int maps = 0;
  for (const ShaderTexture& texture : made.textures()) {
    if (texture.source != ShaderTexture::Source::kMade || !texture.role.empty()) continue;
    if (texture.width != 16 || texture.height != 8) continue;
    ++maps;
    for (int i = 0; i < 16 * 8; ++i) {
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(texture.texels[static_cast<std::size_t>(3 * i + c)],
                  map.texture.channels[c].at(i % 16, i / 16));
      }
    }
  }
  EXPECT_EQ(maps, 1);
}

TEST(CompositorShader, LeavesTheLastFrameAlone) {
  const Subject s;
  const HostFrame frame = test::host_frame(s.buffers.frame, s.scene);
  Compositor compositor({.trusted = true}, busy_look());
  EXPECT_TRUE(test::same_bits(test::wet(compositor, frame), s.expected));
  const std::string plan = to_text(compositor.plan());
  HostFrame half = frame;
  half.display.x1 /= 2;
  half.plane(PlaneId::kShadow) = {};
  compositor.shader(half);
  EXPECT_EQ(to_text(compositor.plan()), plan);
  half.scene.camera.reset();
  EXPECT_THROW(compositor.shader(half), Error);
  EXPECT_EQ(to_text(compositor.plan()), plan);
  EXPECT_TRUE(test::same_bits(test::wet(compositor, frame), s.expected));
}

TEST(CompositorShader, RefusesWhatRunRefuses) {
  const Subject s;
  const HostFrame good = test::host_frame(s.buffers.frame, s.scene);
  Compositor compositor;
  const auto refused = [&](auto&& change) {
    HostFrame frame = good;
    change(frame);
    EXPECT_THROW(compositor.shader(frame), Error);
  };
  refused([](HostFrame& frame) { frame.display = {}; });
  refused([](HostFrame& frame) { frame.display.x1 = 1 << 30; });
  refused([](HostFrame& frame) { frame.plane(PlaneId::kDepth) = {}; });
  refused([](HostFrame& frame) { frame.plane(PlaneId::kColorR).window = {5, 5, 5, 9}; });
  refused([](HostFrame& frame) { frame.scene.camera.reset(); });
  refused([](HostFrame& frame) { frame.scene.water.reset(); });
  refused([](HostFrame& frame) { frame.scene.time = test::kNan; });
  EXPECT_NO_THROW(compositor.shader(good));
  EXPECT_THROW(compositor.shader(good, {.set = 32}), Error);
}

}  // namespace
}  // namespace limpid

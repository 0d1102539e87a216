#include "limpid/gpu/gpu_compositor.h"

#include <cmath>
#include <cstring>
#include <list>
#include <optional>

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>
#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "gpu/gpu.h"
#include "gpu/passage.h"
#include "paths.h"
#include "plan/landscape.h"
#include "shade/bundled.h"

/// Water in the images of a host, by the host's commands, compared with the runner that copies the
/// planes to the device itself.

namespace limpid {
namespace {

using test::Below;
using test::Buffers;

/// A host: its device, and the images that the host has drawn.
class Host {
 public:
  Host() : device(GpuDevice::open("")), commands(device), executor(make_executor(1)) {}

  GpuHost handles() const { return {device->instance(), device->physical(), device->handle()}; }

  /// The planes of a frame as images of floats.
  GpuFrame draw(const Frame& frame, const Scene& scene) {
    GpuFrame drawn;
    drawn.display = frame.display;
    drawn.scene = scene;
    for (const Role& role : roles()) {
      std::vector<View<const float>> views;
      for (int k = 0; k < role.count; ++k) {
        const View<const float>& view = frame.plane(plane_after(role.first, k));
        if (view) views.push_back(view);
      }
      if (views.empty()) continue;
      const Rect window = views[0].window;
      ProgramTexture texture;
      texture.source = ShaderTexture::Source::kPlanes;
      texture.channels = static_cast<int>(views.size());
      texture.width = window.width(), texture.height = window.height();
      texture.fill = [&](int y, float* row, int step) {
        for (std::size_t k = 0; k < views.size(); ++k) {
          for (int x = 0; x < window.width(); ++x) {
            row[std::size_t(x * step) + k] = views[k].at(window.x0 + x, window.y0 + y);
          }
        }
      };
      Passage& image = images_.emplace_back();
      image.fill(device, texture, *executor);
      commands.run([&](VkCommandBuffer c) { image.upload(device->vk(), c); });
      GpuImageView& view = drawn.planes[role.first];
      view = {image.image.view(), image.image.handle(), image.image.format(),
              kRead.layout,       texture.channels,     window};
    }
    return drawn;
  }

  /// An image for pictures of the frame.
  GpuImageView canvas(const Rect& window, Passage& canvas) {
    canvas.fit_output(device, window.size());
    commands.run([&](VkCommandBuffer c) {
      turn(device->vk(), c, canvas.image.handle(), kUnused, kWritten);
    });
    return {canvas.image.view(),
            canvas.image.handle(),
            canvas.image.format(),
            kWritten.layout,
            4,
            window};
  }
  std::vector<float> read(const Passage& canvas) {
    commands.run([&](VkCommandBuffer c) { canvas.download(device->vk(), c); });
    const float* four = canvas.buffer.floats();
    return {four, four + canvas.buffer.size() / sizeof(float)};
  }

  std::shared_ptr<GpuDevice> device;
  GpuCommands commands;
  std::unique_ptr<Executor> executor;

 private:
  std::list<Passage> images_;
};

class GpuHostTest : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (!IsSkipped()) host.emplace();
  }
  std::optional<Host> host;
};

struct Land {
  explicit Land(int seed) : scene(test::simple_scene({130, 80})) {
    scene.camera->view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0.1, 1.6, -1), {0, 1, 0});
    scene.sky = SkyLight{{0.4, 0.5, 0.6}};
    buffers = test::landscape({0, 0, 130, 80}, scene, seed, false, Below::kNone);
    buffers.set(PlaneId::kColorA, [](int x, int y) { return test::noise(x, y, 5); });
  }
  Frame frame(bool with_map = true) const {
    Frame made = buffers.frame;
    if (with_map) made.wave_map = map.texture;
    return made;
  }
  Scene scene;
  test::NoiseMap map{64, 32};
  Buffers buffers{rect_of({1, 1})};
};

/// Four floats a pixel, as the runner makes them.
std::vector<float> expected(const Look& look, const Frame& frame, const Scene& scene) {
  const Rect work = frame.work();
  test::Picture picture(work);
  Target target;  // the picture alone
  target.color = picture.target.color;
  target.alpha = picture.target.alpha;
  GpuRunner().run(make_plan(look, test::inputs_of(frame, scene)), frame, scene, target,
                  *make_executor(1));
  std::vector<float> four;
  for (int y = work.y0; y < work.y1; ++y) {
    for (int x = work.x0; x < work.x1; ++x) {
      for (const View<float>& view : target.color) four.push_back(view.at(x, y));
      four.push_back(target.alpha.at(x, y));
    }
  }
  return four;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(GpuHostTest, GivesTheBitsOfTheRunner) {
  const Land land(11);
  const Look look = test::shipped_look("realistic");
  GpuCompositor water(host->handles(), look);
  water.set_wave_map(land.map.texture);
  const GpuFrame frame = host->draw(land.frame(), land.scene);
  Passage canvas;
  const GpuImageView picture = host->canvas(land.frame().work(), canvas);
  host->commands.run([&](VkCommandBuffer c) { water.record(c, frame, picture); });
  EXPECT_TRUE(same_bits(host->read(canvas), expected(look, land.frame(), land.scene)));
  EXPECT_TRUE(water.plan().keeps<Refraction>());
  EXPECT_EQ(water.left_out(), std::vector<std::string>());
  EXPECT_EQ(water.device(), host->device->name());
}

/// Two frames that are recorded before the first has been run, and a third after, with sines that
/// raise the water and a map that drifts; then another look.
TEST_F(GpuHostTest, KeepsFramesInFlightApart) {
  Land land(12);
  land.scene.water->waves = {{0.05, 2, 1, 0.4, 2}};
  Look look = test::shipped_look("realistic");
  GpuCompositor water(host->handles(), look, {.in_flight = 2});
  water.set_wave_map(land.map.texture);
  GpuFrame frame = host->draw(land.frame(), land.scene);
  Passage canvases[3];
  GpuImageView pictures[3];
  for (int i = 0; i < 3; ++i) pictures[i] = host->canvas(land.frame().work(), canvases[i]);
  const auto record = [&](VkCommandBuffer c, int i) {
    frame.scene.time = 0.7 * i;
    water.record(c, frame, pictures[i]);
  };
  host->commands.run([&](VkCommandBuffer c) {
    record(c, 0);
    record(c, 1);
  });
  host->commands.run([&](VkCommandBuffer c) { record(c, 2); });
  const auto expect_frame = [&](int i) {
    Scene scene = land.scene;
    scene.time = 0.7 * i;
    EXPECT_TRUE(same_bits(host->read(canvases[i]), expected(look, land.frame(), scene))) << i;
  };
  for (int i = 0; i < 3; ++i) expect_frame(i);
  look = test::shipped_look("monogame");
  water.set_look(look);
  host->commands.run([&](VkCommandBuffer c) { record(c, 1); });
  expect_frame(1);
}

/// The picture replaces its own color image, in half floats, as engines keep color.
TEST_F(GpuHostTest, WorksInPlaceInHalves) {
  Land land(13);
  const Rect work = land.frame().work();
  for (int c = 0; c < 4; ++c) {
    const PlaneId plane = plane_after(PlaneId::kColorR, c);
    const View<const float> old = land.buffers.frame.plane(plane);
    std::vector<float> values;
    for (int y = work.y0; y < work.y1; ++y) {
      for (int x = work.x0; x < work.x1; ++x) {
        values.push_back(imath_half_to_float(imath_float_to_half(old.at(x, y))));
      }
    }
    land.buffers.set(plane, [&](int x, int y) {
      return values[static_cast<std::size_t>((y - work.y0) * work.width() + x - work.x0)];
    });
  }
  const Look look = test::shipped_look("realistic");
  GpuFrame frame = host->draw(land.frame(), land.scene);
  GpuImage color(host->device, work.size(), VK_FORMAT_R16G16B16A16_SFLOAT,
                 VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                     VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  const auto pixels = static_cast<std::size_t>(work.area());
  GpuBuffer memory(host->device, 8 * pixels,
                   VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  auto* halves = reinterpret_cast<std::uint16_t*>(memory.bytes());
  for (int y = work.y0; y < work.y1; ++y) {
    for (int x = work.x0; x < work.x1; ++x) {
      for (int c = 0; c < 4; ++c) {
        const PlaneId plane = plane_after(PlaneId::kColorR, c);
        *halves++ = imath_float_to_half(land.buffers.frame.plane(plane).at(x, y));
      }
    }
  }
  VkBufferImageCopy whole{};
  whole.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  whole.imageExtent = {static_cast<std::uint32_t>(work.width()),
                       static_cast<std::uint32_t>(work.height()), 1};
  const GpuImageView picture{
      color.view(), color.handle(), color.format(), VK_IMAGE_LAYOUT_GENERAL, 4, work};
  frame.planes.at(PlaneId::kColorR) = picture;
  GpuCompositor water(host->handles(), look);
  water.set_wave_map(land.map.texture);
  const Vulkan& vk = host->device->vk();
  host->commands.run([&](VkCommandBuffer c) {
    turn(vk, c, color.handle(), kUnused, kCopiedTo);
    vk.vkCmdCopyBufferToImage(c, memory.handle(), color.handle(), kCopiedTo.layout, 1, &whole);
    turn(vk, c, color.handle(), kCopiedTo, kWritten);
    water.record(c, frame, picture);
    turn(vk, c, color.handle(), kWritten, kCopiedFrom);
    vk.vkCmdCopyImageToBuffer(c, color.handle(), kCopiedFrom.layout, memory.handle(), 1, &whole);
  });
  const std::vector<float> wanted = expected(look, land.frame(), land.scene);
  halves = reinterpret_cast<std::uint16_t*>(memory.bytes());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const float got = imath_half_to_float(halves[i]);
    ASSERT_NEAR(got, wanted[i], 1e-3 * std::abs(wanted[i]) + 1e-6) << "value " << i;
  }
}

TEST_F(GpuHostTest, SaysWhatItWouldLeaveOut) {
  const Land land(14);
  const Look look =
      load_look(std::string(LIMPID_DATA) + "/looks/physical.toml");  // whose edges are mixed
  const GpuFrame frame = host->draw(land.frame(), land.scene);
  Passage canvas;
  const GpuImageView picture = host->canvas(land.frame().work(), canvas);
  GpuCompositor strict(host->handles(), look), lax(host->handles(), look, {.leave_out = true});
  for (GpuCompositor* water : {&strict, &lax}) water->set_wave_map(land.map.texture);
  try {
    host->commands.run([&](VkCommandBuffer c) { strict.record(c, frame, picture); });
    FAIL() << "expected a sentence";
  } catch (const Error& error) {
    const std::string said = error.what();
    for (const char* what : {"mixed edges", "refraction.off_frame", "caustics", "leave_out"}) {
      EXPECT_NE(said.find(what), std::string::npos) << said;
    }
  }
  EXPECT_THROW(strict.plan(), Error);
  host->commands.run([&](VkCommandBuffer c) { lax.record(c, frame, picture); });
  EXPECT_GE(lax.left_out().size(), 4u);
  const auto leaves_sky = [&](const std::optional<SkyLight>& sky) {
    Scene scene = land.scene;
    scene.sky = sky;
    const GpuFrame lit = host->draw(land.frame(), scene);
    host->commands.run([&](VkCommandBuffer c) { lax.record(c, lit, picture); });
    const std::string left = join(lax.left_out());
    EXPECT_NE(left.find("the light of the surroundings in the water"), std::string::npos);
    return left.find("the light of the visible sky") != std::string::npos;
  };
  EXPECT_TRUE(leaves_sky({}));
  EXPECT_FALSE(leaves_sky(SkyLight{{0.2, 0.3, 0.4}}));
  for (const float value : host->read(canvas)) ASSERT_TRUE(std::isfinite(value));
}

TEST_F(GpuHostTest, RefusesWhatDoesNotFit) {
  const Land land(16);
  const Look look = test::shipped_look("realistic");
  GpuCompositor water(host->handles(), look);
  water.set_wave_map(land.map.texture);
  const GpuFrame frame = host->draw(land.frame(), land.scene);
  Passage canvas;
  const GpuImageView picture = host->canvas(land.frame().work(), canvas);
  const auto refusal = [&](const GpuFrame& of, const GpuImageView& to) -> std::string {
    try {
      water.record(VK_NULL_HANDLE, of, to);  // unreachable
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  GpuImageView other = picture;
  other.format = VK_FORMAT_R8G8B8A8_UNORM;
  EXPECT_EQ(refusal(frame, other).find("picture: it has the Vulkan format 37"), 0u);
  other = picture;
  other.window.x1 -= 1;
  EXPECT_EQ(refusal(frame, other).find("picture: expected an image that begins with "), 0u);
  GpuFrame wrong = frame;
  wrong.planes.at(PlaneId::kDepth).channels = 2;
  EXPECT_EQ(refusal(wrong, picture), "frame: depth has 2 channels, expected 1");
  wrong = frame;
  wrong.planes.erase(PlaneId::kDepth);
  EXPECT_NE(refusal(wrong, picture), "");
  wrong = frame;
  wrong.planes.at(PlaneId::kColorR).view = nullptr;
  EXPECT_EQ(refusal(wrong, picture), "frame: color has no image view");
  EXPECT_NE(refusal(frame, frame.planes.at(PlaneId::kColorR)).find("in place color"),
            std::string::npos);
  EXPECT_THROW(GpuCompositor({}, look), Error);
  EXPECT_THROW(GpuCompositor(host->handles(), look, {.in_flight = 0}), Error);
}

}  // namespace
}  // namespace limpid

// limpid in an engine that draws with Vulkan, off screen: on its device and its queue, in its color
// target in place (RGBA16F), with its linear depth (R32F), two frames in flight, while the camera
// moves. The engine's own drawing is a sandy bottom and a rock, made on the CPU.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "limpid/gpu/gpu_compositor.h"

#include "device.h"

namespace {

constexpr limpid::Size kSize{480, 270};
constexpr int kPixels = kSize.width * kSize.height, kFrames = 8, kInFlight = 2;

// The objects of one frame in flight.
struct Frame {
  explicit Frame(const Device& device)
      : color(device, VK_FORMAT_R16G16B16A16_SFLOAT, kSize.width, kSize.height),
        depth(device, VK_FORMAT_R32_SFLOAT, kSize.width, kSize.height),
        drawn_color(device, 8 * kPixels),
        drawn_depth(device, 4 * kPixels),
        seen(device, 8 * kPixels) {
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = device.pool;
    info.commandBufferCount = 1;
    expect(vkAllocateCommandBuffers(device.device, &info, &commands), "vkAllocateCommandBuffers");
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    expect(vkCreateFence(device.device, &fence, nullptr, &done), "vkCreateFence");
  }
  ~Frame() { vkDestroyFence(color.owner.device, done, nullptr); }

  Image color, depth;
  Buffer drawn_color, drawn_depth, seen;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence done = VK_NULL_HANDLE;
  int under_water = 0, number = -1;

  // A sandy bottom 1.5 below the water, and a rock that rises above the water.
  void draw(const limpid::Camera& camera) {
    const limpid::Rays rays = rays_of(camera, {kSize.width, kSize.height});
    const glm::dvec3 eye = camera.eye(), rock(0, -0.7, 0);
    auto* rgba = static_cast<std::uint16_t*>(drawn_color.bytes);
    auto* depths = static_cast<float*>(drawn_depth.bytes);
    under_water = 0;
    for (int i = 0; i < kPixels; ++i) {
      const glm::dvec3 ray = rays.ray_at(i % kSize.width + 0.5, i / kSize.width + 0.5);
      glm::dvec3 light(0.5, 0.7, 1);
      double z = ray.y < 0 ? (-1.5 - eye.y) / ray.y : std::numeric_limits<double>::infinity();
      const double a = dot(ray, ray), b = dot(ray, rock - eye), c = dot(rock - eye, rock - eye) - 1;
      if (b * b > a * c) {
        z = (b - std::sqrt(b * b - a * c)) / a;
        light = glm::dvec3(0.3) * (1.2 + (eye + z * ray - rock).y);
      } else if (z < 1e9) {
        const glm::dvec3 at = eye + z * ray;
        light =
            glm::dvec3(0.6, 0.5, 0.35) * (std::sin(3 * at.x) * std::sin(3 * at.z) > 0 ? 1 : 0.7);
      }
      under_water += z < 1e9 && eye.y + z * ray.y < 0;
      depths[i] = static_cast<float>(z);
      for (int k = 0; k < 3; ++k) rgba[4 * i + k] = glm::packHalf1x16(static_cast<float>(light[k]));
      rgba[4 * i + 3] = glm::packHalf1x16(1);
    }
  }

  // Pixels that the water has changed.
  int changed() const {
    const auto* before = static_cast<const std::uint16_t*>(drawn_color.bytes);
    const auto* after = static_cast<const std::uint16_t*>(seen.bytes);
    int count = 0;
    for (int i = 0; i < kPixels; ++i) {
      bool same = true;
      for (int k = 0; k < 3; ++k) same = same && before[4 * i + k] == after[4 * i + k];
      count += same ? 0 : 1;
    }
    return count;
  }
};

// Looks of calm, clear and slightly murky water, without the parameters that need pixels in memory.
limpid::Look engine_look() {
  limpid::Look look;
  look.set("water", "edges", "hard");
  look.set("refraction", "rejection", "snap");
  look.set("refraction", "off_frame", "clamp");
  look.set("caustics", "strength", 0.0);
  look.set("caustics", "sunlight", "straight");
  look.set("depth_fog", "model", "beer_lambert");
  look.set("fresnel_reflection", "source", "constant");
  return look;
}

void run() {
  const Device device;
  limpid::GpuCompositor water({device.instance, device.physical, device.device}, engine_look(),
                              {.in_flight = kInFlight});
  std::printf("on %s\n", water.device().c_str());
  std::vector<std::unique_ptr<Frame>> frames;
  for (int i = 0; i < kInFlight; ++i) frames.push_back(std::make_unique<Frame>(device));

  limpid::GpuFrame scene;
  scene.display = rect_of(kSize);
  scene.scene.water = limpid::WaterPlane{};
  scene.scene.sun = limpid::Sun{normalize(glm::dvec3(0.3, 0.8, -0.5)), {1, 0.95, 0.9}};
  const auto finish = [&](Frame& frame) {
    expect(vkWaitForFences(device.device, 1, &frame.done, VK_TRUE, ~0ull), "vkWaitForFences");
    if (frame.number < 0) return;
    const int changed = frame.changed();
    std::printf("frame %d: %d of %d pixels changed, %d look under water\n", frame.number, changed,
                kPixels, frame.under_water);
    if (std::abs(changed - frame.under_water) > frame.under_water / 100) {
      throw std::runtime_error("the water is not where it should be");
    }
  };
  for (int number = 0; number < kFrames; ++number) {
    Frame& frame = *frames[static_cast<std::size_t>(number % kInFlight)];
    finish(frame);  // the earlier frame of this slot
    limpid::Camera camera;
    camera.view =
        glm::lookAt(glm::dvec3(0.1 * number, 1.5, 4), glm::dvec3(0, -0.5, 0), glm::dvec3(0, 1, 0));
    camera.projection = limpid::perspective(1.0, double(kSize.width) / kSize.height, 0.1, 100,
                                            limpid::ClipSpace::kGl);
    scene.scene.camera = camera;
    scene.scene.time = number / 24.0;
    frame.number = number;
    frame.draw(camera);

    expect(vkResetFences(device.device, 1, &frame.done), "vkResetFences");
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    expect(vkBeginCommandBuffer(frame.commands, &begin), "vkBeginCommandBuffer");
    frame.color.copy_from(frame.commands, frame.drawn_color);  // the engine's own passes
    frame.depth.copy_from(frame.commands, frame.drawn_depth);
    const auto show = [&](const Image& image, int channels) {
      return limpid::GpuImageView{image.view, image.image,  image.format, VK_IMAGE_LAYOUT_GENERAL,
                                  channels,   scene.display};
    };
    scene.planes[limpid::PlaneId::kColorR] = show(frame.color, 4);
    scene.planes[limpid::PlaneId::kDepth] = show(frame.depth, 1);
    water.record(frame.commands, scene, show(frame.color, 4));  // in place
    frame.color.copy_to(frame.commands, frame.seen);            // to be presented
    expect(vkEndCommandBuffer(frame.commands), "vkEndCommandBuffer");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &frame.commands;
    expect(vkQueueSubmit(device.queue, 1, &submit, frame.done), "vkQueueSubmit");
  }
  for (int i = 0; i < kInFlight; ++i) {
    finish(*frames[static_cast<std::size_t>((kFrames + i) % kInFlight)]);
  }
}

}  // namespace

int main() {
  try {
    run();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vulkan_host: %s\n", error.what());
    return EXIT_FAILURE;
  }
}

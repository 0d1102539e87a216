// limpid in a game: on the engine's threads and in its target in place, half RGBA with device depth
// (reversed, far infinite), while the camera moves and the water turns murky.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "limpid/compositor.h"

#include "thread_pool.h"

namespace {

constexpr limpid::Size kSize{480, 270};
constexpr double kNear = 0.1;

/// The engine's picture: a sandy bottom 1.5 below the water, and a rock that rises above the water.
struct Drawn {
  std::vector<std::uint16_t> rgba = std::vector<std::uint16_t>(4 * kSize.width * kSize.height);
  std::vector<float> depth = std::vector<float>(kSize.width * kSize.height);
  int under_water = 0;  ///< pixels

  void draw(const limpid::Camera& camera) {
    const limpid::Rays rays = rays_of(camera, {kSize.width, kSize.height});
    const glm::dvec3 eye = camera.eye(), rock(0, -0.7, 0);
    under_water = 0;
    for (int i = 0; i < kSize.width * kSize.height; ++i) {
      const glm::dvec3 ray = rays.ray_at(i % kSize.width + 0.5, i / kSize.width + 0.5);
      glm::dvec3 color(0.5, 0.7, 1);
      double z = ray.y < 0 ? (-1.5 - eye.y) / ray.y : std::numeric_limits<double>::infinity();
      const double a = dot(ray, ray), b = dot(ray, rock - eye), c = dot(rock - eye, rock - eye) - 1;
      if (b * b > a * c) {
        z = (b - std::sqrt(b * b - a * c)) / a;
        color = glm::dvec3(0.3) * (1.2 + (eye + z * ray - rock).y);
      } else if (z < 1e9) {
        const glm::dvec3 at = eye + z * ray;
        color =
            glm::dvec3(0.6, 0.5, 0.35) * (std::sin(3 * at.x) * std::sin(3 * at.z) > 0 ? 1 : 0.7);
      }
      under_water += z < 1e9 && eye.y + z * ray.y < 0;
      depth[i] = static_cast<float>(kNear / z);  // 1 at the near plane, 0 at infinity
      for (int k = 0; k < 3; ++k) rgba[4 * i + k] = glm::packHalf1x16(static_cast<float>(color[k]));
      rgba[4 * i + 3] = glm::packHalf1x16(1);
    }
  }
};

}  // namespace

int main() {
  using namespace limpid;
  ThreadPool pool(std::thread::hardware_concurrency());
  Drawn target;

  // Once: the engine's kind of depth, and the look of the water.
  Look look;
  look.set("wave_normals", "model", "sines");
  look.set("wave_normals", "waves", Rows{{0.03, 2.1, 0.6, 0}, {0.02, -1.3, 3.2, 1}});
  look.set("fresnel_reflection", "source", "constant");
  look.set("fresnel_reflection", "color", Rgb<double>{0.5, 0.7, 1});
  Compositor water({.depth = DepthKind::kDevice, .clip = ClipSpace::kReversed, .trusted = true},
                   look, {.executor = &pool});

  // Once: the addresses of the buffers. Values that do not change need not be set again.
  HostFrame frame{.display = rect_of(kSize), .planes = {}, .scene = {}};
  HostPicture picture;
  for (int c = 0; c < 4; ++c) {
    const HostOutput channel = interleaved<void>(target.rgba.data(), Sample::kHalf, 4, c, kSize);
    frame.planes[c] = channel;
    (c < 3 ? picture.color[c] : picture.alpha) = channel;
  }
  frame.plane(PlaneId::kDepth) = planar<const void>(target.depth.data(), Sample::kFloat, kSize);
  frame.scene.water = WaterPlane{};
  frame.scene.sun = Sun{normalize(glm::dvec3(0.3, 1, 0.5)), {3, 2.8, 2.5}};
  Camera camera;
  camera.projection = perspective(0.9, double(kSize.width) / kSize.height, kNear,
                                  std::numeric_limits<double>::infinity(), ClipSpace::kReversed);

  constexpr int kFrames = 36;
  std::chrono::duration<double> spent{};
  int wet = 0;
  for (int i = 0; i < kFrames; ++i) {
    const glm::dvec3 eye(4 * std::sin(0.02 * i), 1.6, 4 * std::cos(0.02 * i));
    camera.view = glm::lookAt(eye, glm::dvec3(0), glm::dvec3(0, 1, 0));
    target.draw(camera);
    const std::vector<std::uint16_t> dry = target.rgba;

    const auto begin = std::chrono::steady_clock::now();
    if (i == kFrames / 2) {
      look.set("depth_fog", "water_type", "5C");
      water.set_look(look);
    }
    frame.scene.camera = camera;
    frame.scene.time = i / 60.0;
    water.run(frame, picture);
    spent += std::chrono::steady_clock::now() - begin;

    wet = 0;
    for (std::size_t p = 0; p < dry.size(); p += 4) {
      wet += !std::equal(&dry[p], &dry[p] + 3, &target.rgba[p]);
    }
  }
  std::printf("%d frames of %dx%d: %.0f a second, %d of %d pixels under water are wet\n", kFrames,
              kSize.width, kSize.height, kFrames / spent.count(), wet, target.under_water);
  // If the depth were misread, there would be water on the rock's top, or no water at all.
  return std::abs(wet - target.under_water) > target.under_water / 100;
}

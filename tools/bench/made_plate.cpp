#include "made_plate.h"

#include <cmath>
#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace limpid::bench {
namespace {

constexpr float kNothingHit = std::numeric_limits<float>::infinity();

/// Waves as a sum of sines: slopes along world x and z.
glm::dvec2 slopes(double x, double z) {
  glm::dvec2 s(0);
  double amplitude = 0.05;
  for (int i = 0; i < 5; ++i) {
    const double angle = 0.7 + 1.3 * i, k = 1.5 * std::pow(1.7, i);
    const glm::dvec2 d(std::cos(angle), std::sin(angle));
    s += amplitude * std::cos(k * (d.x * x + d.y * z) + 1.7 * i) * d;
    amplitude *= 0.8;
  }
  return s;
}

}  // namespace

MadePlate::MadePlate(Size size) {
  Camera camera;
  camera.view = glm::lookAt(glm::dvec3(0, 2.5, 0), glm::dvec3(0.3, 1.25, -8), glm::dvec3(0, 1, 0));
  camera.projection = perspective(0.6, double(size.width) / size.height, 0.1, 500, ClipSpace::kGl);
  scene.camera = camera;
  scene.water = WaterPlane{};
  scene.sun = Sun{glm::normalize(glm::dvec3(-0.2, 0.45, -0.87)), {3, 2.8, 2.4}};

  frame.display = rect_of(size);
  planes_.reserve(kPlaneCount);
  for (int i = 0; i < kPlaneCount; ++i) {
    planes_.emplace_back(frame.display);
    frame.planes[i] = planes_.back().view();
  }
  const auto put = [&](PlaneId id, int x, int y, double value) {
    planes_[index_of(id)].view().at(x, y) = static_cast<float>(value);
  };
  const Rays rays = rays_of(camera, {size.width, size.height});
  const glm::dvec3 eye = camera.eye();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
      const double water = ray.y < 0 ? -eye.y / ray.y : kNothingHit;
      // The bottom falls away from the viewer, then rises to a far shore; rocks are bumps on a
      // grid.
      const glm::dvec3 at = eye + std::min(water, 60.0) * ray;
      const double cell_x = std::floor(at.x / 3), cell_z = std::floor(at.z / 3);
      const double rock = std::hypot(at.x - 3 * cell_x - 1.5 - 0.5 * std::sin(7 * cell_x + cell_z),
                                     at.z - 3 * cell_z - 1.5) -
                          0.35;
      const bool on_rock = rock < 0 && std::fmod(std::abs(cell_x * 3 + cell_z * 5), 4) < 1;
      const bool ashore = at.z < -28 || water > 60;
      double depth = water * (1 + (0.3 + 0.1 * std::sin(at.x) + 0.02 * -at.z) / eye.y);
      if (on_rock) depth = water * 0.97;
      if (ashore) depth = ray.y < 0.02 ? 30 : kNothingHit;
      put(PlaneId::kDepth, x, y, depth);
      put(PlaneId::kSurfaceDepth, x, y, water);
      const double texture = 0.5 + 0.3 * std::sin(9 * at.x) * std::sin(8 * at.z) +
                             0.2 * std::sin(43 * at.x + 31 * at.z);
      for (int c = 0; c < 3; ++c) {
        const PlaneId color = plane_after(PlaneId::kColorR, c);
        const PlaneId mirror = plane_after(PlaneId::kReflectionR, c);
        put(color, x, y, ashore ? 0.4 + 0.2 * c : on_rock ? 0.2 : texture * (0.6 - 0.1 * c));
        put(mirror, x, y,
            0.4 + 0.3 * c + 0.2 * std::sin(0.01 * x + c) + (x / 90 % 7 == 0 ? -0.2 : 0));
      }
      put(PlaneId::kColorA, x, y, 1);
      put(PlaneId::kShadow, x, y, std::fmod(std::abs(at.x + 0.3 * at.z), 2.5) < 0.5 ? 0 : 1);
      const glm::dvec2 s = slopes(at.x, at.z);
      const glm::dvec3 n = glm::normalize(glm::dvec3(-s.x, 1, -s.y));
      put(PlaneId::kSurfaceNormalX, x, y, n.x);
      put(PlaneId::kSurfaceNormalY, x, y, n.y);
      put(PlaneId::kSurfaceNormalZ, x, y, n.z);
    }
  }
}

}  // namespace limpid::bench

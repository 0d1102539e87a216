#include "made_plate.h"

#include <cmath>
#include <limits>
#include <numbers>

#define IMATH_HALF_NO_LOOKUP_TABLE  // the table would need a library to link
#include <Imath/half.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace limpid::bench {
namespace {

constexpr float kNoHit = std::numeric_limits<float>::infinity();

constexpr PlaneId kPlanes[] = {PlaneId::kColorR,      PlaneId::kColorG,      PlaneId::kColorB,
                               PlaneId::kColorA,      PlaneId::kDepth,       PlaneId::kShadow,
                               PlaneId::kReflectionR, PlaneId::kReflectionG, PlaneId::kReflectionB,
                               PlaneId::kSurfaceDepth};

constexpr int kMapSize = 512;

/// Slopes of the waves in the map: a sum of sines with whole periods in the map. The longest wave
/// is the map's side, the shortest a thirtieth of it.
glm::dvec2 slopes(double u, double v) {
  constexpr int kWaves[][2] = {{1, 2},  {-2, 1}, {3, 2},   {2, -4},  {-5, 3}, {6, 4},
                               {-3, 8}, {9, -5}, {11, 10}, {-15, 7}, {8, 19}, {27, -12}};
  glm::dvec2 sum(0);
  for (const auto& wave : kWaves) {
    const glm::dvec2 k(wave[0], wave[1]);
    const double length = glm::length(k);
    const double phase = 2 * std::numbers::pi * (k.x * u + k.y * v) + 2.4 * length;
    sum += 0.16 * std::pow(length, -0.6) * std::cos(phase) / length * k;
  }
  return sum;
}

/// A normal's component with the precision of a PNG: whole 255ths.
float as_byte(double component) {
  return static_cast<float>(std::round(255 * (0.5 + 0.5 * component))) / 255;
}

}  // namespace

MadePlate::MadePlate(Size size) {
  Camera camera;
  camera.view = glm::lookAt(glm::dvec3(0, 2.5, 0), glm::dvec3(0.3, 1.25, -8), glm::dvec3(0, 1, 0));
  camera.projection = perspective(0.6, double(size.width) / size.height, 0.1, 500, ClipSpace::kGl);
  scene.camera = camera;
  scene.water = WaterPlane{};
  scene.sun = Sun{glm::normalize(glm::dvec3(-0.2, 0.45, -0.87)), {3, 2.8, 2.4}};
  scene.time = 1.7;  // no lookup of the map falls on whole texels

  make_map();
  frame.display = rect_of(size);
  for (const PlaneId id : kPlanes) {
    planes_[index_of(id)] = Plane(frame.display);
    frame.planes[index_of(id)] = planes_[index_of(id)].view();
  }
  const auto put = [&](PlaneId id, int x, int y, double value) {
    planes_[index_of(id)].view().at(x, y) = static_cast<float>(value);
  };
  // Colors are rounded to half, as in files.
  const auto put_color = [&](PlaneId id, int x, int y, double value) {
    put(id, x, y, imath_half_to_float(imath_float_to_half(static_cast<float>(value))));
  };
  const Rays rays = rays_of(camera, {size.width, size.height});
  const glm::dvec3 eye = camera.eye();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
      const double water = ray.y < 0 ? -eye.y / ray.y : kNoHit;
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
      if (ashore) depth = ray.y < 0.02 ? 30 : kNoHit;
      put(PlaneId::kDepth, x, y, depth);
      put(PlaneId::kSurfaceDepth, x, y, water);
      const double texture = 0.5 + 0.3 * std::sin(9 * at.x) * std::sin(8 * at.z) +
                             0.2 * std::sin(43 * at.x + 31 * at.z);
      for (int c = 0; c < 3; ++c) {
        const PlaneId color = plane_after(PlaneId::kColorR, c);
        const PlaneId mirror = plane_after(PlaneId::kReflectionR, c);
        put_color(color, x, y, ashore ? 0.4 + 0.2 * c : on_rock ? 0.2 : texture * (0.6 - 0.1 * c));
        put_color(mirror, x, y,
                  0.4 + 0.3 * c + 0.2 * std::sin(0.01 * x + c) + (x / 90 % 7 == 0 ? -0.2 : 0));
      }
      put(PlaneId::kColorA, x, y, 1);
      put(PlaneId::kShadow, x, y, std::fmod(std::abs(at.x + 0.3 * at.z), 2.5) < 0.5 ? 0 : 1);
    }
  }
}

void MadePlate::make_map() {
  const Rect window = rect_of({kMapSize, kMapSize});
  for (int c = 0; c < 3; ++c) {
    map_[c] = Plane(window);
    frame.wave_map.channels[c] = map_[c].view();
  }
  for (int y = 0; y < kMapSize; ++y) {
    for (int x = 0; x < kMapSize; ++x) {
      const glm::dvec2 s = slopes((x + 0.5) / kMapSize, (y + 0.5) / kMapSize);
      const glm::dvec3 n = glm::normalize(glm::dvec3(-s.x, -s.y, 1));
      for (int c = 0; c < 3; ++c) map_[c].view().at(x, y) = as_byte(n[c]);
    }
  }
  map_bytes_ = pack_bytes(frame.wave_map);
  frame.wave_map.bytes = map_bytes_.data();
  map_levels_.make(frame.wave_map);
  frame.wave_map.levels = &map_levels_.levels();
}

double MadePlate::wet_share() const {
  const View<const float>& water = frame.plane(PlaneId::kSurfaceDepth);
  const View<const float>& dry = frame.plane(PlaneId::kDepth);
  const Rect& w = frame.display;
  double wet = 0;
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) wet += water.at(x, y) < dry.at(x, y);
  }
  return wet / (double(w.width()) * w.height());
}

}  // namespace limpid::bench

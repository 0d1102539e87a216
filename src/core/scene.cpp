#include "limpid/core/scene.h"

#include <cmath>
#include <cstdio>
#include <string>

#include <glm/geometric.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

void expect_unit(const char* what, const glm::dvec3& v) {
  const double size = glm::length(v);
  if (!(std::abs(size - 1) < 1e-6)) {
    throw Error(std::string(what) + " has length " + std::to_string(size) +
                ", expected a unit vector");
  }
}

void expect_light(const char* name, const Rgb<double>& light) {
  for (double c : {light.r, light.g, light.b}) {
    if (c >= 0 && c <= Sun::kBrightest) continue;
    char text[96];
    std::snprintf(text, sizeof text, "%s has a channel %g, expected 0 ... %g", name, c,
                  Sun::kBrightest);
    throw Error(text);
  }
}

/// sqrt(9.81 |k|), from |k| / 256: the product stays finite for every finite k, and the powers of
/// two are exact.
double deep_water_omega(double k_x, double k_y) {
  return 16 * std::sqrt(9.81 * std::hypot(k_x / 256, k_y / 256));
}

}  // namespace

SineWave SineWave::from_row(std::span<const double> row) {
  const double omega = row.size() > 4 ? row[4] : deep_water_omega(row[1], row[2]);
  return {row[0], row[1], row[2], row[3], omega};
}

PlaneAxes plane_axes(const glm::dvec3& up) {
  const auto flat = [&](const glm::dvec3& v) { return v - glm::dot(v, up) * up; };
  glm::dvec3 x = flat({1, 0, 0});
  if (glm::length(x) < 1e-6) x = flat({0, 0, 1});
  x = glm::normalize(x);
  return {x, glm::cross(up, x)};
}

void Scene::validate() const {
  if (camera) camera->validate();
  if (water) {
    expect_unit("water.up", water->up);
    if (!std::isfinite(water->height)) throw Error("water.height is not a finite number");
    for (const SineWave& w : water->waves) {
      for (double x : {w.amplitude, w.k_x, w.k_y, w.phase, w.omega}) {
        if (!std::isfinite(x)) throw Error("water.waves holds a number that is not finite");
      }
    }
  }
  if (sun) {
    expect_unit("sun.direction", sun->direction);
    expect_light("sun.color", sun->color);
    if (!(sun->diameter >= Sun::kNarrowest && sun->diameter <= Sun::kWidest)) {
      throw Error("sun.diameter = " + std::to_string(sun->diameter) +
                  " degrees, expected 0.01 ... 90");
    }
  }
  if (sky) expect_light("sky.radiance", sky->radiance);
  if (!(part.index >= 0 && part.index < part.count)) {
    throw Error("part " + std::to_string(part.index) + " of " + std::to_string(part.count) +
                " of a pixel, expected 0 ... count - 1");
  }
  primaries.validate();
  if (!std::isfinite(time)) throw Error("time is not a finite number of seconds");
}

}  // namespace limpid

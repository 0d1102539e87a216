#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "judge/trace/truth.h"
#include "raster/raster_scenes.h"

/// Small pools for the tests of the tracer.

namespace limpid::test {

constexpr Size kTraceSize{33, 25};
constexpr double kTraceIor = 1.333;

/// A level floor that extends `reach` to each side, under calm water at y = 0.
inline Mesh level(double y, double reach = 200) {
  const float r = static_cast<float>(reach), h = static_cast<float>(y);
  return quad({-r, h, r}, {r, h, r}, {r, h, -r}, {-r, h, -r});
}

inline Material lambert(Rgb<double> color, Rgb<double> ambient = {0.2, 0.2, 0.2}) {
  Material m;
  m.base_color = color;
  m.ambient = ambient;
  return m;
}

/// A camera 2 above the water, which looks down by an angle in degrees, and a sun.
inline Scene over_water(double degrees, Size size = kTraceSize) {
  const double a = degrees * std::numbers::pi / 180;
  Scene scene;
  const glm::dvec3 eye(0.3, 2, 0.1), to(0, -std::sin(a), -std::cos(a));
  scene.camera = Camera{
      glm::lookAt(eye, eye + to, glm::dvec3(0, std::cos(a), -std::sin(a))),
      perspective(0.7, double(size.width) / size.height, 0.1, 1e3, ClipSpace::kGl), ClipSpace::kGl};
  scene.water = WaterPlane{};
  scene.sun = Sun{glm::normalize(glm::dvec3(0.3, 0.8, -0.4)), {3, 2.5, 2}};
  return scene;
}

/// No waves, one index, black surroundings, no glint.
inline Look calm_look() {
  Look look;
  look.water.ior = kTraceIor;
  look.of<WaveNormals>().strength = 0;
  look.of<PrismSplit>().gain = 0;
  look.of<FresnelReflection>().source = FresnelReflection::Source::kConstant;
  look.of<FresnelReflection>().color = {0, 0, 0};
  look.of<SunHighlight>().strength = 0;
  return look;
}

inline std::vector<Aov> truth_aovs() {
  std::vector<Aov> list;
  for (int i = 0; i < kAovCount; ++i) {
    const bool traced = !aovs()[static_cast<std::size_t>(i)].of_buffers;
    if (traced) list.push_back(static_cast<Aov>(i));
  }
  return list;
}

inline TruthOptions every_aov(Size size = kTraceSize) {
  TruthOptions options;
  options.size = size;
  options.aovs = truth_aovs();
  options.visible = true;
  options.light = TruthOptions::Light::kOnce;
  return options;
}

inline TruthPicture traced(const Model& model, const Scene& scene, const Look& look,
                           const TruthOptions& options = every_aov(), int threads = 1) {
  return trace_truth(model, scene, look, options, *make_executor(threads));
}

inline double value(const TruthPicture& p, Aov aov, int x, int y, int c = 0) {
  return p.target.of(aov)[static_cast<std::size_t>(c)].at(x, y);
}
inline double channel(const Rgb<double>& color, int c) {
  return c == 0 ? color.r : c == 1 ? color.g : color.b;
}

/// The unit direction through a pixel's centre.
inline glm::dvec3 view_through(const Scene& scene, int x, int y, Size size = kTraceSize) {
  return glm::normalize(rays_of(*scene.camera, {size.width, size.height}).ray_at(x + 0.5, y + 0.5));
}

/// The position of a world point in the picture; (0, 0) is the lower left.
inline glm::dvec2 place_of(const Scene& scene, const glm::dvec3& point) {
  const glm::dvec4 clip = scene.camera->projection * scene.camera->view * glm::dvec4(point, 1);
  return {0.5 + 0.5 * clip.x / clip.w, 0.5 + 0.5 * clip.y / clip.w};
}

template <class Fn>
void for_each_pixel(Size size, Fn&& fn) {
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) fn(x, y);
  }
}

}  // namespace limpid::test

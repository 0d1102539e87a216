#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "limpid/raster/rasterise.h"

/// Small made-up models and views for the tests of the rasteriser.

namespace limpid::test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Deterministic numbers in 0 ... 1.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 2 + 1) {}
  double next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 40) / (1 << 24);
  }
  double between(double low, double high) { return low + (high - low) * next(); }
  int below(int count) { return static_cast<int>(next() * count); }

 private:
  std::uint64_t state_;
};

/// An orthographic view in which pixel coordinates are world coordinates: (x, -y, -depth).
inline RasterView flat_view(int width, int height) {
  RasterView view;
  view.display = view.window = {0, 0, width, height};
  view.camera.projection = orthographic(width, height, -100, 100, ClipSpace::kGl);
  view.camera.view = glm::translate(glm::dmat4(1), glm::dvec3(-0.5 * width, 0.5 * height, 0));
  return view;
}

/// The point of a pixel of flat_view.
inline glm::vec3 pixel_point(double x, double y, double depth = 0) {
  return glm::vec3(x, -y, -depth);
}

inline RasterView perspective_view(int width, int height, const glm::dvec3& eye,
                                   const glm::dvec3& target, ClipSpace clip = ClipSpace::kReversed,
                                   double near = 0.1, double far = kInfinity) {
  RasterView view;
  view.display = view.window = {0, 0, width, height};
  view.camera.clip = clip;
  view.camera.projection = perspective(1.0, double(width) / height, near, far, clip);
  view.camera.view = glm::lookAt(eye, target, glm::dvec3(0, 1, 0));
  return view;
}

inline Material white(Shading shading = Shading::kFlat) {
  Material m;
  m.shading = shading;
  return m;
}

inline Mesh triangles(std::vector<glm::vec3> positions) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < positions.size(); ++i) mesh.indices.push_back(i);
  mesh.positions = std::move(positions);
  return mesh;
}

/// Counter-clockwise seen from the front, as two triangles; uv 0 0 at `a`, 1 0 at `b`, 0 1 at `d`.
inline Mesh quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
  Mesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

inline Model model_of(std::vector<Mesh> meshes, Material material = white()) {
  Model model;
  model.materials = {std::move(material)};
  model.background = {0.25, 0.5, 0.75};
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    Instance instance;
    instance.mesh = static_cast<int>(i);
    model.instances.push_back(instance);
  }
  model.meshes = std::move(meshes);
  return model;
}

constexpr RasterWanted kEverything{true, true, true, true, true};

inline RasterImage drawn(const Model& model, const RasterView& view,
                         const RasterLighting& lighting = {}, RasterWanted wanted = kEverything,
                         const std::string& simd = "") {
  return rasterise(model, view, lighting, wanted, *make_executor(1), simd);
}

inline float at(const Plane& plane, int x, int y) { return plane.view().at(x, y); }

/// All pixels of all planes, one after the other.
inline std::vector<float> values(const RasterImage& image) {
  std::vector<float> all;
  const auto add = [&](const Plane& plane) {
    if (!plane) return;
    const View<const float> view = plane.view();
    for (int y = view.window.y0; y < view.window.y1; ++y) {
      for (int x = view.window.x0; x < view.window.x1; ++x) all.push_back(view.at(x, y));
    }
  };
  for (const Plane& plane : image.color) add(plane);
  add(image.depth);
  add(image.coverage);
  add(image.shadow);
  for (const Plane& plane : image.normal) add(plane);
  return all;
}

/// A grid of size x size cells over `extent` in x and z, its height a sum of waves, with smooth
/// normals and uvs.
inline Mesh hills(int size, double extent, double height) {
  Mesh mesh;
  for (int j = 0; j <= size; ++j) {
    for (int i = 0; i <= size; ++i) {
      const double x = extent * (double(i) / size - 0.5), z = extent * (double(j) / size - 0.5);
      const double k = 7 / extent;
      mesh.positions.emplace_back(x, height * std::sin(k * x) * std::cos(k * z), z);
      const glm::dvec3 n(-height * k * std::cos(k * x) * std::cos(k * z), 1,
                         height * k * std::sin(k * x) * std::sin(k * z));
      mesh.normals.emplace_back(glm::normalize(n));
      mesh.uvs.emplace_back(8.0 * i / size, 8.0 * j / size);
    }
  }
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(j * (size + 1) + i); };
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      mesh.indices.insert(mesh.indices.end(), {index(i, j), index(i, j + 1), index(i + 1, j)});
      mesh.indices.insert(mesh.indices.end(),
                          {index(i + 1, j), index(i, j + 1), index(i + 1, j + 1)});
    }
  }
  return mesh;
}

/// `size` x `size` texels, 1 and 0 in turn.
inline ModelTexture checker(int size) {
  ModelTexture texture{size, size, {}};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float value = (x + y) % 2 ? 0.0f : 1.0f;
      texture.rgba.insert(texture.rgba.end(), {value, value, value, 1});
    }
  }
  return texture;
}

/// Hills of every material, seen from above their middle; some hills lie behind the camera.
inline Model mixed_model() {
  Model model;
  for (Shading shading :
       {Shading::kFlat, Shading::kTextured, Shading::kLambert, Shading::kPhong, Shading::kToon}) {
    Material m = white(shading);
    m.base_color = {0.9, 0.5, 0.2 * static_cast<double>(model.instances.size())};
    if (shading != Shading::kFlat) m.base_texture = 0;
    if (shading == Shading::kPhong) m.specular_texture = 0;
    m.double_sided = shading == Shading::kToon;
    Mesh mesh = hills(24, 10, 0.6);
    if (shading == Shading::kLambert) mesh.normals.clear();
    mesh.material = static_cast<int>(model.materials.size());
    Instance instance;
    instance.mesh = mesh.material;
    instance.world_from_mesh =
        glm::translate(glm::dmat4(1), glm::dvec3(0, 0.3 * mesh.material, -4.0 * mesh.material)) *
        glm::rotate(glm::dmat4(1), 0.4 * mesh.material, glm::dvec3(0.2, 1, 0.1));
    model.materials.push_back(m);
    model.meshes.push_back(std::move(mesh));
    model.instances.push_back(instance);
  }
  model.textures = {checker(16)};
  return model;
}

inline RasterView mixed_view(int width, int height) {
  return perspective_view(width, height, {1, 2.5, 3}, {0, 0, -4});
}

inline RasterLighting low_sun() {
  return {Sun{glm::normalize(glm::dvec3(0.5, 0.6, -0.4)), {2, 1.8, 1.5}}, nullptr};
}

}  // namespace limpid::test

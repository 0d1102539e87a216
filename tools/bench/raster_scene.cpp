#include "raster_scene.h"

#include <cmath>
#include <cstdint>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace limpid::bench {
namespace {

/// size x size cells over 16 x 9.4 units, smooth normals, the texture repeated eight times.
Mesh hills(int size) {
  Mesh mesh;
  const double height = 0.4, k = 1.3;
  for (int j = 0; j <= size; ++j) {
    for (int i = 0; i <= size; ++i) {
      const double u = double(i) / size, v = double(j) / size;
      const double x = 16 * (u - 0.5), z = 9.4 * (v - 0.5);
      mesh.positions.emplace_back(x, height * std::sin(k * x) * std::cos(k * z), z);
      mesh.normals.emplace_back(
          glm::normalize(glm::dvec3(-height * k * std::cos(k * x) * std::cos(k * z), 1,
                                    height * k * std::sin(k * x) * std::sin(k * z))));
      mesh.uvs.emplace_back(8 * u, 8 * v);
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

/// Soft stripes, in steps of 1/255 so that eight bits hold them exactly.
ModelTexture stripes(int size) {
  ModelTexture texture{size, size, {}};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double phase = 6.283185307179586 / size;
      for (double wave :
           {std::sin(7 * phase * x), std::sin(5 * phase * y), std::sin(3 * phase * (x + y))}) {
        texture.rgba.push_back(static_cast<float>(std::round(127.5 + 100 * wave) / 255));
      }
      texture.rgba.push_back(1);
    }
  }
  return texture;
}

}  // namespace

RasterScene raster_scene(int index) {
  constexpr int kCells[kRasterScenes] = {316, 1000, 16};
  constexpr const char* kLabels[kRasterScenes] = {"200k triangles", "2M triangles",
                                                  "512 large triangles"};
  RasterScene scene;
  scene.label = kLabels[index];
  scene.model.meshes = {hills(kCells[index])};
  scene.model.textures = {stripes(512)};
  Material material;
  material.shading = Shading::kPhong;
  material.base_texture = 0;
  material.specular = {0.8, 0.8, 0.8};
  scene.model.materials = {material};
  scene.model.instances.emplace_back();
  scene.view.display = scene.view.window = {0, 0, 1920, 1080};
  scene.view.camera.view =
      glm::lookAt(glm::dvec3(0, 8, 0.5), glm::dvec3(0, 0, 0), glm::dvec3(0, 1, 0));
  scene.view.camera.projection = perspective(1.0, 16.0 / 9, 0.1, 100, ClipSpace::kGl);
  scene.lighting.sun = {glm::normalize(glm::dvec3(0.3, 0.8, -0.4)), {1.5, 1.4, 1.2}};
  return scene;
}

}  // namespace limpid::bench

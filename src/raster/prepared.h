#pragma once
#include <cstdint>
#include <vector>

#include "limpid/raster/model.h"

#include "raster/pyramid.h"
#include "raster/raster_job.h"

namespace limpid::raster {

/// A mesh that has normals: the model's own arrays, or, where it has none, corners of its own for
/// each triangle with the face's normal.
struct PreparedMesh {
  MeshView view{};
  std::uint32_t vertices = 0, triangles = 0;
  std::vector<float> positions, normals, uvs;
  std::vector<std::uint32_t> indices;
};

/// A model as the stages read it, checked. Keeps pointers into it.
struct PreparedModel {
  explicit PreparedModel(const Model& model);

  const Model& model;
  std::vector<PreparedMesh> meshes;
  std::vector<Pyramid> pyramids;
  std::vector<MaterialView> materials;
  std::int64_t degenerate_triangles = 0;
};

}  // namespace limpid::raster

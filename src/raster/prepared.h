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
  int material = 0;  ///< in PreparedModel::materials
  std::vector<float> positions, normals, uvs, second_uvs, colors;
  std::vector<std::uint32_t> indices;
};

/// What vertices of the mesh have beside normal and uv.
inline bool has_more(const MeshView& mesh) { return mesh.second_uvs || mesh.colors; }
MoreAttributes more_of(const MeshView& mesh, std::uint32_t vertex);

/// A model as the stages read it, checked. Keeps pointers into it.
struct PreparedModel {
  explicit PreparedModel(const Model& model);

  const Model& model;
  std::vector<PreparedMesh> meshes;
  std::vector<Pyramid> pyramids;
  /// The model's, and then one for each mesh with colors.
  std::vector<MaterialView> materials;
  std::int64_t degenerate_triangles = 0;
};

}  // namespace limpid::raster

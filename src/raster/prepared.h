#pragma once
#include <cstdint>
#include <vector>

#include "limpid/raster/model.h"

#include "raster/pyramid.h"
#include "raster/raster_job.h"

namespace limpid::raster {

/// A mesh with normals: the model's own arrays, or, if it has no normals, separate corners for each
/// triangle with the face's normal.
struct PreparedMesh {
  MeshView view{};
  std::uint32_t vertices = 0, triangles = 0;
  int material = 0;  ///< index in PreparedModel::materials
  std::vector<float> positions, normals, uvs, second_uvs, colors;
  std::vector<std::uint32_t> indices;
};

/// Whether vertices of the mesh have attributes besides normal and uv.
inline bool has_more(const MeshView& mesh) { return mesh.second_uvs || mesh.colors; }
MoreAttributes more_of(const MeshView& mesh, std::uint32_t vertex);

/// A checked model in the form of the stages. Keeps pointers into the model.
struct PreparedModel {
  explicit PreparedModel(const Model& model);

  const Model& model;
  std::vector<PreparedMesh> meshes;
  std::vector<Pyramid> pyramids;
  /// The model's, followed by one for each mesh with colors.
  std::vector<MaterialView> materials;
  std::int64_t degenerate_triangles = 0;
};

}  // namespace limpid::raster

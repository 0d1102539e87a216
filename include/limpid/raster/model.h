#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/plane.h"
#include "limpid/core/scene.h"

/// @file
/// Geometry to be rendered, as plain data: what a glTF file holds that the raster pass draws. World
/// space, scene units, right-handed. Complete and checked when made: indices are in range, numbers
/// finite, transforms flattened.

namespace limpid {

/// How a surface answers light. Base color c (times its texture), unit normal n, L to the sun, V to
/// the viewer, R the mirrored L, sun color S:
/// - flat: c
/// - textured: c from the texture, unlit
/// - lambert: c (ambient + sat(n.L) shadow S)
/// - phong: lambert + specular sat(R.V)^power shadow S, the latter only where n.L is above 0
/// - toon: c (ambient + ceil(5 sat(n.L) shadow) / 5 S)
enum class Shading : std::uint8_t { kFlat, kTextured, kLambert, kPhong, kToon };

/// RGBA float texels, linear, rows from the top; v runs down as in glTF. Repeats in both
/// directions.
struct ModelTexture {
  int width = 0, height = 0;
  std::vector<float> rgba;
};

struct Material {
  std::string name;
  Shading shading = Shading::kLambert;
  Rgb<double> base_color{1, 1, 1};
  int base_texture = -1;  ///< index of a texture, or -1; multiplies base_color
  Rgb<double> ambient{0.2, 0.2, 0.2};
  Rgb<double> specular{1, 1, 1};
  int specular_texture = -1;  ///< multiplies specular
  double power = 20;
  bool double_sided = false;  ///< else back faces are culled
};

/// Triangles with one material. Normals and uvs are empty or one a vertex; without normals faces
/// are shaded flat.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit
  std::vector<glm::vec2> uvs;
  std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise seen from the front
  int material = 0;
};

/// A mesh put into the world. The matrix is affine and its determinant above 0: a mirrored mesh is
/// stored as a mesh of its own, so that its triangles stay counter-clockwise from the front.
struct Instance {
  int mesh = 0;
  glm::dmat4 world_from_mesh{1.0};
  bool water = false;  ///< the water surface itself: drawn into the surface planes only
};

struct Model {
  std::vector<Mesh> meshes;
  std::vector<Material> materials;  ///< at least one
  std::vector<ModelTexture> textures;
  std::vector<Instance> instances;
  std::optional<Camera> camera;  ///< the first camera; aspect 1 where the file does not say
  std::optional<Sun> sun;        ///< the first directional light
  Rgb<double> background{0.5, 0.7, 1.0};
  std::int64_t skipped_triangles = 0;  ///< zero-area or otherwise degenerate, left out
  /// What of the file is not drawn, or not as the file says: a sentence each, without the file's
  /// name. Names in the sentences are those of the file, of any bytes.
  std::vector<std::string> warnings;
};

}  // namespace limpid

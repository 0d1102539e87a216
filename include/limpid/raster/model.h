#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "limpid/core/plane.h"
#include "limpid/core/scene.h"

/// @file
/// Geometry to render, as plain data: the parts of a glTF file that the rasteriser draws. World
/// space, scene units, right-handed. Loaders check a model: indices are in range, numbers finite,
/// transforms flattened.

namespace limpid {

/// The shading models. Base color c (times its texture), unit normal n, L to the sun, V to the
/// viewer, R the mirrored L, sun color S:
/// - flat: c
/// - textured: c from the texture, unlit
/// - lambert: c (ambient + sat(n.L) shadow S)
/// - phong: lambert + specular sat(R.V)^power shadow S, the latter only where n.L is above 0
/// - toon: c (ambient + ceil(5 sat(n.L) shadow) / 5 S) and the emission of the surface is added to
///   each.
enum class Shading : std::uint8_t { kFlat, kTextured, kLambert, kPhong, kToon };

/// The effect of the opacity of a surface, which is the material's alpha times the alpha of its
/// base texture and of the vertex color, clamped to 1:
/// - opaque: none
/// - mask: parts below the cutoff are removed; the rest is opaque
/// - blend: color is blended over the surfaces behind. Parts below kSeenFrom are removed, and parts
///   from kOpaqueFrom on are opaque
///
/// A pixel has one depth, and so has a texel of the shadow map: that of the nearest surface that is
/// opaque, masked and not removed, or blended with an opacity of at least kBlocksFrom. Depth,
/// coverage, normal and shadow are those of this surface; only color has all surfaces. By the same
/// rule a blended surface casts a full shadow or none. Each blended surface is shaded at its own
/// position, and the kBlendedLayers nearest layers of a pixel are blended, or fewer if less than
/// 1/4096 shows through them; farther layers are left out.
enum class AlphaMode : std::uint8_t { kOpaque, kMask, kBlend };
constexpr double kSeenFrom = 1.0 / 512, kBlocksFrom = 0.5, kOpaqueFrom = 511.0 / 512;
constexpr int kBlendedLayers = 64;

/// The wrapping of a texture outside of 0 ... 1: repetition, its outermost texels, or mirrored
/// repetition.
enum class Wrap : std::uint8_t { kRepeat, kClamp, kMirror };

/// The uv set and wrapping of a texture of a material.
struct TextureLookup {
  int uv_set = 0;  ///< 0: Mesh::uvs, 1: Mesh::second_uvs
  Wrap wrap_u = Wrap::kRepeat, wrap_v = Wrap::kRepeat;
  friend bool operator==(const TextureLookup&, const TextureLookup&) = default;
};

/// RGBA float texels, linear, rows from the top; v runs down as in glTF. Alpha is not multiplied
/// into the color.
struct ModelTexture {
  int width = 0, height = 0;
  std::vector<float> rgba;
};

struct Material {
  std::string name;
  Shading shading = Shading::kLambert;
  Rgb<double> base_color{1, 1, 1};
  int base_texture = -1;  ///< index of a texture, or -1; multiplies base_color and alpha
  TextureLookup base_lookup;
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  double alpha = 1;
  double alpha_cutoff = 0.5;  ///< for AlphaMode::kMask; above 1 removes the whole surface
  Rgb<double> emission{0, 0, 0};
  int emissive_texture = -1;  ///< multiplies emission
  TextureLookup emissive_lookup;
  Rgb<double> ambient{0.2, 0.2, 0.2};
  Rgb<double> specular{1, 1, 1};
  int specular_texture = -1;  ///< multiplies specular
  TextureLookup specular_lookup;
  double power = 20;
  bool double_sided = false;  ///< else back faces are culled
};

/// Triangles with one material. Normals, uvs and colors are empty or one per vertex; without
/// normals faces are shaded flat, without uvs they are 0.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec2> second_uvs;
  std::vector<glm::vec4> colors;       ///< linear; multiply the material's base color and alpha
  std::vector<std::uint32_t> indices;  ///< three per triangle, counter-clockwise from the front
  int material = 0;
};

/// A mesh in the world. The matrix is affine, with a determinant above 0: a mirrored mesh is stored
/// as a separate mesh, so that its triangles stay counter-clockwise from the front.
struct Instance {
  int mesh = 0;
  glm::dmat4 world_from_mesh{1.0};
  bool water = false;  ///< the water surface, drawn into the surface planes only
};

struct Model {
  std::vector<Mesh> meshes;
  std::vector<Material> materials;  ///< at least one
  std::vector<ModelTexture> textures;
  std::vector<Instance> instances;
  std::optional<Camera> camera;  ///< the first camera; aspect 1 if the file has none
  std::optional<Sun> sun;        ///< the first directional light
  Rgb<double> background{0.5, 0.7, 1.0};
  std::int64_t skipped_triangles = 0;  ///< number of degenerate triangles, which are left out
  /// Sentences on parts of the file that are not drawn, or not drawn as the file describes, without
  /// the file's name. Names in the sentences come from the file and may have any bytes.
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;  ///< all files of the model
};

}  // namespace limpid

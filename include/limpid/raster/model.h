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
/// and the light that the surface sends out itself is added to each.
enum class Shading : std::uint8_t { kFlat, kTextured, kLambert, kPhong, kToon };

/// What the opacity of a surface does. It is the material's alpha, times that of its base texture
/// and of the vertex color, cut at 1:
/// - opaque: nothing
/// - mask: where it is below the cutoff nothing is there; the rest is opaque
/// - blend: color is blended over what lies behind. Nothing is there below kSeenFrom, and the
///   surface is opaque from kOpaqueFrom on
///
/// A pixel has one depth, and so has a texel of the shadow map: that of the nearest surface that is
/// opaque, masked and there, or blended with an opacity of at least kBlocksFrom. Depth, coverage,
/// normal and shadow tell of that one; color alone of all. A blended surface throws the whole
/// shadow or none by the same rule. Its color is blended in the light of its own place, up to the
/// kBlendedLayers nearest layers of a pixel, or until less than 1/4096 shows through them; farther
/// ones are left out.
enum class AlphaMode : std::uint8_t { kOpaque, kMask, kBlend };
constexpr double kSeenFrom = 1.0 / 512, kBlocksFrom = 0.5, kOpaqueFrom = 511.0 / 512;
constexpr int kBlendedLayers = 64;

/// What a texture shows outside 0 ... 1: itself again, its outermost texels, or its mirror image.
enum class Wrap : std::uint8_t { kRepeat, kClamp, kMirror };

/// How a material looks a texture up.
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
  double alpha_cutoff = 0.5;  ///< for AlphaMode::kMask; above 1 nothing is there
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

/// Triangles with one material. Normals, uvs and colors are empty or one a vertex; without normals
/// faces are shaded flat, without uvs they are 0.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec2> second_uvs;
  std::vector<glm::vec4> colors;       ///< linear; multiply the material's base color and alpha
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
  std::vector<std::filesystem::path> files;  ///< that it was read from
};

}  // namespace limpid

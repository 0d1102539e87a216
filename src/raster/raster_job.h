#pragma once
#include <cstdint>

#include "limpid/core/rect.h"
#include "limpid/raster/model.h"

/// The data that the stages of the rasteriser pass on, as plain structs: stages compiled for an
/// instruction set include nothing else. Screen positions are fixed-point, 1/256 pixel, relative to
/// the pixel corner Screen::origin. `q` is the reversed depth: 1 / Z for perspective, -Z for
/// orthographic cameras; linear on the screen, larger is nearer.

namespace limpid::raster {

constexpr int kSubpixels = 256;
constexpr std::int32_t kGuard = 16384 * kSubpixels;  ///< the farthest position of a corner
constexpr std::int32_t kClipped = -(1 << 30);  ///< x of a corner to be clipped, plus its ClipBits
constexpr int kTile = 64;
constexpr std::uint32_t kNothing = 0xffffffffu;

/// A transformed vertex, in two parts: the data for visibility, and the rest.
struct alignas(16) Corner {
  std::int32_t x, y;
  float q, normal_x;
};
struct alignas(16) Attributes {
  float normal_y, normal_z, u, v;
};

/// Attributes that few vertices have, read only for materials that need them.
struct alignas(16) MoreAttributes {
  float color[4] = {1, 1, 1, 1};
  float u = 0, v = 0;  ///< of the second set
};

/// A triangle that may be visible, corners clockwise on the screen. q = a x + b y + c at the pixel
/// coordinates x, y (from Screen::origin), clamped to q_min ... q_max.
struct alignas(16) Triangle {
  static constexpr std::uint32_t kBack = 1u << 31;  ///< seen from behind
  static constexpr std::uint32_t kMaterial = kBack - 1;
  std::uint32_t corner[3];
  std::uint32_t material;
  double a, b, c;
  float q_min, q_max;
};

/// Half-spaces; a triangle with a corner outside is clipped.
enum ClipBits { kNear = 1, kFar = 2, kUser = 4, kLeft = 8, kRight = 16, kTop = 32, kBottom = 64 };

/// From a mesh vertex (x, y, z, 1) to the screen: x and y times w in fixed-point units, the eye
/// depth Z, and the distances to the clip planes (any scale, positive inside). w is Z for
/// perspective, 1 for orthographic cameras.
struct VertexTransform {
  enum Row { kX, kY, kDepth, kNearDistance, kFarDistance, kUserDistance, kRows };
  double row[kRows][4];
  double normal[3][3];  ///< world from mesh, for normals
  bool perspective;
};

/// A mesh in the form of the stages; three floats per vertex, uvs two or null, colors four or null.
struct MeshView {
  const float* positions;
  const float* normals;
  const float* uvs;
  const float* second_uvs;
  const float* colors;
  const std::uint32_t* indices;
};

/// The plane of a triangle gives q as a quotient of these: n = (p1 - p0) x (p2 - p0) in the mesh,
/// and the rays of the camera brought there. With d = n.(determinant p0 + offset):
///   perspective:  q = (n.ray + x n.ray_dx + y n.ray_dy) / d
///   orthographic: q = (n.ray - d + x n.ray_dx + y n.ray_dy) / n.axis
struct PlaneRays {
  double ray[3], ray_dx[3], ray_dy[3], axis[3], offset[3];
  double determinant;
  bool perspective;
};

/// An instance of the model in this view.
struct DrawnInstance {
  MeshView mesh;
  VertexTransform transform;
  PlaneRays rays;
  std::uint32_t first_vertex, vertices;
  std::uint32_t triangles;
  std::uint32_t material;
  AlphaMode alpha;
  bool flip;  ///< front faces are counter-clockwise in fixed-point space
  bool cull;  ///< leave out back faces
};

/// Pixels of the window, from Screen::origin.
struct Screen {
  int origin_x, origin_y;
  int x0, y0, x1, y1;
};

/// Triangles of one instance that are set up together. Arrays have room for kGroup triangles, each
/// cut into at most kPieces, and one vector.
constexpr int kGroup = 8192, kPieces = 8, kSlack = 64;

/// What is left of a group after culling, one array each: corner numbers (clockwise), the pixels
/// that the triangle may cover, whether it shows its back.
struct Survivors {
  std::int32_t *corner[3], *back;
  std::int32_t *x0, *y0, *x1, *y1;
  std::int32_t* to_clip;  ///< triangle numbers
  int count, clip_count;
};

/// The entries of a group's tiles: those of tile (tx, ty) are entries[offsets[t]] ...
/// entries[offsets[t + 1] - 1] with t = (ty - ty0) (tx1 - tx0) + tx - tx0; each is a triangle.
struct GroupView {
  const Triangle* triangles;
  const std::uint32_t* entries;
  const std::uint32_t* offsets;
  int tx0, ty0, tx1, ty1;
};

/// A texture's mip chain, level after level, four floats per texel. Level l is max(1, width >> l)
/// wide.
struct PyramidView {
  const float* texels;
  int width, height, levels;
  std::int32_t level_start[32];  ///< texels
};

struct MaterialView {
  Shading shading;
  float base[3], ambient[3], specular[3], power;
  const PyramidView* base_texture;      ///< or null
  const PyramidView* specular_texture;  ///< or null
  bool plain;                           ///< all members below have their defaults
  bool vertex_colors;
  float emission[3];
  const PyramidView* emissive_texture;  ///< or null
  TextureLookup base_lookup, specular_lookup, emissive_lookup;
  AlphaMode alpha_mode;  ///< opaque also if every fragment is
  float alpha;
  float solid_from;   ///< a fragment of at least this opacity hides all behind it
  float blocks_from;  ///< a fragment of at least this opacity has the pixel's depth
};

/// The shadow map seen from the eye: for points relative to `eye`.
struct ShadowView {
  const float* depth;  ///< null without a map
  int size, y_stride;
  float map[3][4];   ///< texel x, texel y, depth of (point - eye, 1)
  float side[2][3];  ///< the two axes across the sun's direction
  float bias_texels, max_slope, bias;
};

struct ShadeJob {
  Screen screen;
  bool perspective;
  int tiles_across;
  const GroupView* groups;  ///< groups of opaque materials first, then masked, then blended
  int opaque_groups, unblended_groups, group_count;
  const Corner* corners;
  const Attributes* attributes;
  const MoreAttributes* more;  ///< or null
  const MaterialView* materials;
  double origin[3], origin_dx[3], origin_dy[3];  ///< of the eye ray at pixel coordinates
  double ray[3], ray_dx[3], ray_dy[3];
  float background[3];
  float sun_direction[3], sun_color[3];
  ShadowView shadow;
  bool lit;    ///< any output besides depth and coverage
  bool plain;  ///< all drawn materials are plain
  std::ptrdiff_t y_stride;
  float *color[3], *depth, *coverage, *shadow_out, *normal[3];  ///< null if not needed
};

/// The stages, compiled for one instruction set.
struct RasterTarget {
  void (*transform)(const DrawnInstance& instance, int first, int count, Corner* corners,
                    Attributes* attributes);
  void (*cull)(const DrawnInstance& instance, const Screen& screen, const Corner* corners,
               int first, int count, Survivors& survivors);
  void (*set_up)(const DrawnInstance& instance, const Corner* corners, const Survivors& survivors,
                 Triangle* triangles);
  void (*draw_tile)(const ShadeJob& job, int tile);
};

}  // namespace limpid::raster

#pragma once
#include <span>
#include <string>

#include "limpid/core/plane.h"
#include "limpid/core/vec.h"

namespace limpid {

/// A sine along a row: its phase, in rad, and its height at the row's first place.
struct SineOfRow {
  double phase, step;  ///< step: gain of the phase from place to place
  float amplitude, slope_x, slope_y;
};

/// A row of a tile of slopes, x and y interleaved, with the first texel repeated at its end.
struct TileRow {
  const float* slopes;
  int texels;
  double first, step;  ///< of the places, in texels; the first lies within the tile
};

/// A number that changes evenly along a row.
struct EvenRow {
  double first = 0, step = 0;
};

/// A row of the calm surface, projected into the picture. The position in the planes of a frame's
/// normals, in texels from the centre of the first one, is (u, v) / w; where w <= 0 the picture
/// does not show it.
struct NormalRow {
  View<const float> normal[3] = {};  ///< of one window
  EvenRow u{}, v{}, w{};
  Vec3<float> map_x{}, map_y{}, up{};
  float least_up = 0;  ///< lower limit of the upward component of a normal
};

/// Adjacent places in a row of the surface.
struct SurfaceRow {
  float *height, *slope_x, *slope_y;
};

/// Sunlight from a row of the surface. Lengths are in texels of the table, places from its first
/// texel.
struct LightRow {
  float sun_x, sun_y, sun_z;  ///< unit, towards the sun, z up
  float ior, eta;             ///< index and 1 / index
  float per_calm;             ///< 1 / transmission of a calm surface; 0: all waves transmit equally
  float calm_x, calm_y;       ///< sideways travel of calm light per unit of depth
  float share;                ///< share of a texel's light in a ray of a sun straight above
  float per_length;           ///< texels per scene unit
  float first_x, step_x, at_y;  ///< places of the row
  const float* bottom;          ///< depths in scene units, `across` cells in each of `down` rows
  int across, down;
  float per_cell, cell_x;  ///< 1 / texels of a cell; the first texel is in its middle
  float edge;              ///< an edge parts neighbouring cells whose depths differ by more
};

/// The place that each ray lights, in texels, and its light.
struct LitRow {
  float *x, *y, *power;
};

/// Light as it is laid into the table. A ray is as wide as neighbouring rays are apart, and never
/// wider than `widest` texels, 2 or 3.
struct BeamRow {
  LitRow above, here, below;  ///< three rows of rays; they have a ray more at both ends
  int width, height, stride;  ///< of the table, and from one of its rows to the next in memory
  int widest;
};

/// The light that a ray adds to `widest` + 1 rows of the table, four texels each, from `texel` on.
struct SplatRow {
  int* texel;
  float *along, *down;  ///< four per ray: light of each column, share of each row
};

/// Rows of the table that a row's light reaches: none if last is before first.
struct RowsHit {
  int first, last;
};

/// Light of a row, and its neighbours before and after each texel along an axis.
struct FilterRow {
  const float *before, *here, *after;
  const float* depth;
  float spread;  ///< variance of the sun's disc on the bottom, in texels, per unit of depth
  float blur;    ///< variance of the blur that the light already has
};

struct Extremes {
  float least, most;
};

/// Row functions of CausticsMaker, compiled for one instruction set.
struct CausticsTarget {
  void (*add_sines)(std::span<const SineOfRow> sines, int count, const SurfaceRow& to);
  void (*read_tile)(const TileRow& tile, int count, const SurfaceRow& to);
  /// Slopes of 0 where the planes do not show the place.
  void (*read_normals)(const NormalRow& row, int count, const SurfaceRow& to);
  void (*follow)(const LightRow& light, int count, const SurfaceRow& surface, const LitRow& to);
  RowsHit (*spread)(const BeamRow& beams, int count, const SplatRow& to);
  void (*splat)(const SplatRow& from, int count, int stride, int widest, float* light);
  /// to[i] = (1 - v) here[i] + v / 2 (before[i] + after[i]), v = min(spread depth[i]^2 - blur,
  /// 2/3).
  Extremes (*filter)(const FilterRow& row, int count, float* to);
};

/// For `simd` as in FusedOptions.
const CausticsTarget& caustics_target(const std::string& simd);

}  // namespace limpid

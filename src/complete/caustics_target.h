#pragma once
#include <span>
#include <string>

namespace limpid {

/// A sine along a row: its phase, in rad, at the row's first place, and what it adds there.
struct SineOfRow {
  double phase, step;  ///< and how much the phase gains from one place to the next
  float amplitude, slope_x, slope_y;
};

/// A row of a tile of slopes, x and y in turns, the first texel once more at its end.
struct TileRow {
  const float* slopes;
  int texels;
  double first, step;  ///< of the places, in texels; the first within the tile
};

/// Of places side by side in a row of the surface.
struct SurfaceRow {
  float *height, *slope_x, *slope_y;
};

/// Where sunlight goes from a row of the surface. Lengths are in texels of the table, places from
/// its first texel.
struct LightRow {
  float sun_x, sun_y, sun_z;    ///< unit, towards the sun, z up
  float ior, eta;               ///< index and 1 / index
  float per_calm;               ///< 1 / what passes a calm surface; 0: as much passes all waves
  float calm_x, calm_y;         ///< how far aside calm light goes for each unit that it sinks
  float share;                  ///< of a ray, were the sun straight above, of the light of a texel
  float per_length;             ///< texels in a scene unit
  float first_x, step_x, at_y;  ///< places of the row
  const float* bottom;          ///< depths in scene units, `across` cells in each of `down` rows
  int across, down;
  float per_cell, cell_x;  ///< of a cell in texels; the table's first texel is in the cell's middle
  float edge;              ///< cells side by side that differ by more are parted by an edge
};

/// Where the light of each place comes to, in texels, and how much it is.
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

/// What a ray adds to `widest` + 1 rows of the table, from the first texel on: of each four texels.
struct SplatRow {
  int* texel;
  float *along, *down;  ///< four of each ray: light of each column, share of each row
};

/// Rows of the table that any light of a row comes to: none if last is before first.
struct RowsHit {
  int first, last;
};

/// Light of a row, and what lies before and after each texel along an axis.
struct FilterRow {
  const float *before, *here, *after;
  const float* depth;
  float spread;  ///< variance of the sun's disc on the bottom, in texels, one unit deep
  float blur;    ///< that of what has blurred the light already
};

struct Extremes {
  float least, most;
};

/// Rows of CausticsMaker as compiled for one instruction set.
struct CausticsTarget {
  void (*add_sines)(std::span<const SineOfRow> sines, int count, const SurfaceRow& to);
  void (*read_tile)(const TileRow& tile, int count, const SurfaceRow& to);
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

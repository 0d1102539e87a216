#pragma once
#include <span>
#include <string>

namespace limpid {

/// A sine along a row: its phase, in rad, at the row's first place, and what it adds there.
struct SineOfRow {
  double phase, step;  ///< and how much the phase gains from one place to the next
  float amplitude, slope_x, slope_y;
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
  int width, height;       ///< of the table; its rows have a texel more before them and after them
};

/// Where the light of each place goes: the texel, from that before the table's first one, and what
/// of the light goes to it and to its neighbours.
struct SplatRow {
  int* texel;
  float *here, *right, *below, *beside;
};

/// Rows of CausticsMaker as compiled for one instruction set.
struct CausticsTarget {
  void (*add_sines)(std::span<const SineOfRow> sines, int count, const SurfaceRow& to);
  void (*follow)(const LightRow& light, int count, const SurfaceRow& surface, const SplatRow& to);
};

/// For `simd` as in FusedOptions.
const CausticsTarget& caustics_target(const std::string& simd);

}  // namespace limpid

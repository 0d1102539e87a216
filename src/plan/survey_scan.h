#pragma once
#include <string>

#include "limpid/core/plane.h"
#include "limpid/core/rect.h"

#include "core/water_view.h"
#include "op/height_bound.h"

namespace limpid {

/// Wet pixels of a cell, and the range of their water. Where the frame has no plane of the surface,
/// the calm surface is computed in float, with other rounding than in a run: a doubtful pixel
/// counts as wet.
struct WetSeen {
  int wet;                          ///< pixels, at most
  int sure;                         ///< pixels, at least
  float surface_near, surface_far;  ///< eye depth of the surface where it is wet
  float own_near, own_far;          ///< dry eye depth less the surface's, at wet pixels
};

/// Bounds on the errors of `over` and `under`, where a point at eye depth z has the height over + z
/// under.
struct HeightError {
  float over, under;
};
/// The error of RowRays.
HeightError calm_error(const WaterView& view);

/// The view and the query for which SeenHeights are made.
struct SeenFrom {
  HeightError error;     ///< error of the lookups that the bounds serve
  float most;            ///< HeightBound::most
  double path_fraction;  ///< the fraction for SeenHeights::covers, or 0 if no lookup uses it
  bool calm_ashore;      ///< the calm surface replaces an infinitely far surface
};

/// Blocks of a row, `width` pixels wide from x0 on. Scanned together, because memory is fastest
/// along a row of the picture.
struct Blocks {
  static constexpr int kMost = 32;
  int x0, width;
};

/// The scan of the planes, compiled for one instruction set. `pixels` lie within the windows;
/// out[i] is for those in block i, and unchanged if it has none. Without `farthest`, WetSeen lacks
/// surface_near and own_far, which are then 0 and infinite.
struct ScanTarget {
  void (*range)(const View<const float>& view, const Rect& pixels, Blocks blocks, SeenRange* out);
  /// Greatest height over the calm surface of the finite texels of a surface.
  void (*highest_water)(const WaterView& view, const View<const float>& surface, const Rect& pixels,
                        Blocks blocks, float* out);
  /// `surface` has the window of `depth`, or is absent for calm water.
  void (*seen_heights)(const WaterView& view, const SeenFrom& from, const View<const float>& depth,
                       const View<const float>& surface, const Rect& pixels, Blocks blocks,
                       SeenHeights* out);
  /// Depths of all texels, or of those that may lie `above` the calm surface.
  void (*seen_depths)(const WaterView& view, const HeightError& error,
                      const View<const float>& depth, bool above, const Rect& pixels, Blocks blocks,
                      SeenRange* out);
  void (*wet)(const WaterView& view, const HeightError& error, const View<const float>& depth,
              const View<const float>& surface, const Rect& pixels, Blocks blocks, bool farthest,
              WetSeen* out);
};

/// For `simd` as in FusedOptions.
const ScanTarget& scan_target(const std::string& simd);

}  // namespace limpid

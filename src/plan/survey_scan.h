#pragma once
#include <string>

#include "limpid/core/plane.h"
#include "limpid/core/rect.h"

#include "core/water_view.h"
#include "op/height_bound.h"

namespace limpid {

/// Which pixels of a cell are wet, and how the water lies there. Where the frame has no plane of
/// the surface, the calm one is computed in float, and not to the same bits as in a run: what
/// cannot be told for sure counts for wet.
struct WetSeen {
  int wet;                          ///< pixels, at most
  int sure;                         ///< pixels, at least
  float surface_near, surface_far;  ///< eye depth of the surface where it is wet
  float own_near, own_far;          ///< dry eye depth less the surface's, there
};

/// How far off `over` and `under` may be, where what lies at eye depth z has the height over + z
/// under.
struct HeightError {
  float over, under;
};
/// Of RowRays.
HeightError calm_error(const WaterView& view);

/// What SeenHeights are made for.
struct SeenFrom {
  HeightError error;     ///< of who asks
  float most;            ///< HeightBound::most
  double path_fraction;  ///< that SeenHeights::covers speaks of, or 0 where nobody asks
  bool calm_ashore;      ///< the calm surface stands for one that is infinitely far
};

/// Blocks of a row of them, `width` pixels wide from x0 on. Memory is read fastest along a row of
/// the picture: so they are looked at together.
struct Blocks {
  static constexpr int kMost = 32;
  int x0, width;
};

/// The look at the planes, as compiled for one instruction set. `pixels` lie within the windows;
/// out[i] is of those in block i, and left alone where there are none. Unless `farthest`, all of
/// WetSeen is found but surface_near and own_far, which are 0 and infinite then.
struct ScanTarget {
  void (*range)(const View<const float>& view, const Rect& pixels, Blocks blocks, SeenRange* out);
  /// Greatest height over the calm surface of the finite texels of a surface.
  void (*highest_water)(const WaterView& view, const View<const float>& surface, const Rect& pixels,
                        Blocks blocks, float* out);
  /// `surface` has the window of `depth`, or is absent, for the calm one.
  void (*seen_heights)(const WaterView& view, const SeenFrom& from, const View<const float>& depth,
                       const View<const float>& surface, const Rect& pixels, Blocks blocks,
                       SeenHeights* out);
  /// Of all texels, or of those `above` the calm surface, by all that is known.
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

#pragma once
#include "judge/compare/color_pair.h"
#include "judge/compare/error_map.h"

namespace limpid {

/// Viewing conditions. The default is a display 3840 pixels and .7 m wide, .7 m away.
struct Observer {
  static constexpr double kUsualPixelsPerDegree = 67.02064327658226;
  double pixels_per_degree = kUsualPixelsPerDegree;  ///< 1 ... 1000
};

/// FLIP, the visible error if the two pictures are shown in turn on the same display (Andersson,
/// Nilsson, Akenine-Moller, Oskarsson, Astrom & Fairchild 2020 "FLIP: A Difference Evaluator for
/// Alternating Images"). Values are clamped to 0 ... 1, as a display would; display encoding and
/// decoding cancel and are left out. Beyond its sides the picture repeats its edge. Symmetric, to
/// the bit. Float, in a fixed order: the same bits for any number of threads. Throws Error for
/// different windows and an invalid observer.
ErrorMap flip(const ColorPair& pictures, const Observer& observer = {});

/// Exposures for a picture beyond a display's range, in stops.
struct Exposures {
  double start = 0;  ///< shows the brightest pixel below white
  double stop = 0;   ///< shows the pixel of median luminance at that tone
  int count = 2;     ///< evenly from start to stop

  friend bool operator==(const Exposures&, const Exposures&) = default;
};

/// Exposures for a reference, from its luminance (Andersson, Nilsson, Shirley & Akenine-Moller 2021
/// "Visualizing Errors in Rendered High Dynamic Range Images"). Cases that the paper leaves open:
/// negative values and pixels with NaN or inf count as black, the median as at least 2^-24 of the
/// brightest, and a black picture gets exposure 0.
Exposures exposures_of(const ColorViews& reference);

/// HDR-FLIP of the same paper: the largest FLIP of a pixel over all exposures, tone mapped by
/// Narkowicz 2015 "ACES Filmic Tone Mapping Curve". Negative values count as black. Not symmetric,
/// because the exposures are those of `b`; the second form takes them as an argument. Otherwise
/// like flip().
ErrorMap hdr_flip(const ColorPair& pictures, const Observer& observer = {});
ErrorMap hdr_flip(const ColorPair& pictures, const Exposures& exposures,
                  const Observer& observer = {});

}  // namespace limpid

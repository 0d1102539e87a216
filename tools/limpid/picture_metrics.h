#pragma once
#include <optional>
#include <string>

#include "arguments.h"
#include "compared_picture.h"
#include "judge/compare/flip.h"
#include "judge/compare/offset.h"
#include "judge/compare/ssim.h"

/// The metrics of `compare --metrics`, besides differences of numbers.

namespace limpid::tool {

struct WantedMetrics {
  bool ssim = false, flip = false, hdr_flip = false, offset = false;
  bool all = false;  ///< offset is then computed only for files that have it
  Observer observer;
  std::optional<double> clip;
  std::optional<Primaries> primaries;  ///< of linear pictures, instead of what they say

  bool of_color() const { return ssim || flip || hdr_flip; }
};

/// Throws the usage Error for unknown metrics, and for options that need a metric. A FLIP map
/// requires FLIP.
WantedMetrics wanted_metrics(const CompareArguments& arguments);

struct PictureMetrics {
  std::optional<Ssim> ssim;
  std::optional<ErrorMap> flip, hdr_flip;
  std::string spaces;   ///< of the two pictures, where their light was made that of Rec.709
  Exposures exposures;  ///< of hdr_flip
  std::optional<OffsetComparison> offset;
  bool below = false;     ///< lookups used the layer below the water
  std::string visible;    ///< the truth's channels that judged it
  std::string no_offset;  ///< why it was not measured, if all metrics are requested

  /// False if a lookup is NaN or infinite.
  bool is_finite() const { return !offset || offset->overall.mismatches == 0; }
};

/// Throws Error for pictures that lack channels of a metric.
PictureMetrics measure(const WantedMetrics& wanted, const ComparedPicture& a,
                       const ComparedPicture& b, const Limits& limits);

/// One or more lines per metric, "" for none.
std::string to_text(const PictureMetrics& metrics, const WantedMetrics& wanted);

/// The map of FLIP, or of HDR-FLIP if only that was measured: 0 is dark, 1 is bright, mismatches
/// are magenta.
void write_flip_map(const std::string& path, const PictureMetrics& metrics);

}  // namespace limpid::tool

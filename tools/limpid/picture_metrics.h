#pragma once
#include <optional>
#include <string>

#include "arguments.h"
#include "compared_picture.h"
#include "judge/compare/flip.h"
#include "judge/compare/offset.h"
#include "judge/compare/ssim.h"

/// What `compare --metrics` computes besides the difference of numbers.

namespace limpid::tool {

struct WantedMetrics {
  bool ssim = false, flip = false, hdr_flip = false, offset = false;
  bool all = false;  ///< offset is then wanted only of files that have it
  Observer observer;
  std::optional<double> clip;
  std::optional<Primaries> primaries;  ///< of linear pictures, instead of what they say

  bool of_color() const { return ssim || flip || hdr_flip; }
};

/// Throws the usage Error for metrics that there are not, and for options that mean nothing without
/// one. A FLIP map that is to be written wants FLIP.
WantedMetrics wanted_metrics(const CompareArguments& arguments);

struct PictureMetrics {
  std::optional<Ssim> ssim;
  std::optional<ErrorMap> flip, hdr_flip;
  std::string spaces;   ///< of the two pictures, where their light was made that of Rec.709
  Exposures exposures;  ///< of hdr_flip
  std::optional<OffsetComparison> offset;
  bool below = false;     ///< its lookups went into a picture of what lies below the water alone
  std::string visible;    ///< the truth's channels that it was judged by
  std::string no_offset;  ///< why it was not measured, where all metrics are wanted

  /// False where what was looked up is not even a number.
  bool sane() const { return !offset || offset->overall.mismatches == 0; }
};

/// Throws Error for pictures that lack what a metric needs.
PictureMetrics measure(const WantedMetrics& wanted, const ComparedPicture& a,
                       const ComparedPicture& b, const Limits& limits);

/// A line or more a metric, "" for none.
std::string to_text(const PictureMetrics& metrics, const WantedMetrics& wanted);

/// Of FLIP, or of HDR-FLIP where only that was measured: 0 is dark, 1 is bright, mismatches are
/// magenta.
void write_flip_map(const std::string& path, const PictureMetrics& metrics);

}  // namespace limpid::tool

#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "limpid/core/plane.h"

namespace limpid {

/// One channel of two pictures: `b` is the reference. All windows must be equal.
struct ComparedChannel {
  std::string name;
  View<const float> a, b;
};

/// a - b|: 0 for equal infinities and for two NaN, +inf if only one of the two is NaN or they are
/// different infinities (a *mismatch*). Never NaN, so that no NaN can make a comparison pass.
double difference(float a, float b);

/// Three numbers as the limit: a pixel is *over* if its largest difference exceeds `per_pixel`; at
/// most `allowed_percent` of the pixels may be over, none may exceed `hard_limit`.
struct Tolerance {
  double per_pixel = 1e-6;
  double allowed_percent = 0;
  double hard_limit = std::numeric_limits<double>::infinity();
};

struct CompareOptions {
  Tolerance tolerance = {};
  double epsilon = 1e-2;  ///< of the relative error, see Metrics::rel_mse
  std::optional<double> clip =
      {};  ///< larger values, +inf too, count as this value, in both pictures
};

/// A place where the pictures differ.
struct Offender {
  int x = 0, y = 0;
  int channel = 0;  ///< index of the channel with the largest difference
  float a = 0, b = 0;
};

/// Metrics of one channel, or of the values of all channels together. A mismatch is an infinite
/// difference: a single one makes the means infinite.
struct Metrics {
  double mean = 0;                      ///< of |a - b|
  double rmse = 0;                      ///< sqrt(mean((a - b)^2))
  double rel_mse = 0;                   ///< mean((a - b)^2 / (b^2 + epsilon))
  double psnr = 0;                      ///< dB, peak 1: -20 log10(rmse); +inf when equal
  double max = 0;                       ///< of |a - b|
  Offender max_at;                      ///< the first place of `max`; meaningless when max is 0
  double p50 = 0, p99 = 0, p99_99 = 0;  ///< |a - b| that this share of values does not exceed
  std::int64_t mismatches = 0;          ///< values
  std::int64_t both_nan = 0;            ///< values that are NaN in both pictures: counted as equal
  std::int64_t over = 0;                ///< pixels
  double over_percent = 0;              ///< of all pixels
};

struct Comparison {
  Rect window;
  CompareOptions options;
  std::vector<std::string> names;
  std::vector<Metrics> channels;  ///< one per name
  Metrics overall;
  std::vector<Offender> offenders;  ///< the first five pixels that are over, in reading order
};

/// Compares pixel by pixel in a fixed order, with sums in double: the same bits for any number of
/// threads. Needs 8 bytes per value for the exact percentiles. Throws Error for no channel,
/// different windows, and invalid options (NaN, negative).
Comparison compare(std::span<const ComparedChannel> channels, const CompareOptions& options = {});

/// Whether the comparison is within its tolerance. A mismatch never is.
bool within(const Comparison& comparison);

/// The comparison as text, in the words of `idiff`; the last line is PASS or FAILURE.
std::string to_text(const Comparison& comparison);
/// The same without that line, which other metrics decide, too.
std::string numbers_text(const Comparison& comparison);

}  // namespace limpid

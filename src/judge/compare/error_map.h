#pragma once
#include <cstdint>
#include <string>

#include "limpid/core/plane.h"

namespace limpid {

/// An error per pixel and its statistics over the picture: 0 ... 1, or +inf at mismatches
/// (color_pair.h). One mismatch makes `mean` and `max` infinite.
struct ErrorMap {
  Plane map;
  double mean = 0;
  double weighted_median = 0;  ///< pixels of at most this error have half of the sum of all errors
  double p99 = 0;              ///< the error that this share of pixels does not exceed
  double max = 0;
  std::int64_t mismatches = 0;  ///< pixels
};

/// "0.0312, weighted median 0.12, 99% 0.3, max 0.84".
std::string to_text(const ErrorMap& error);

}  // namespace limpid

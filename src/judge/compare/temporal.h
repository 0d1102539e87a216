#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "judge/compare/compare.h"

namespace limpid {

/// Difference of the frame-to-frame change from that of the truth: |(a1 - a0) - (b1 - b0)|, over
/// the values of all channels. 0 for an error that is equal in both frames. Mismatches (compare.h)
/// in either frame count as +inf, and one makes `mean`, `rms` and `max` infinite; NaN in both
/// pictures, and equal infinities, are no error.
struct Flicker {
  double mean = 0;
  double rms = 0;  ///< dtSSD of Erofeev et al. 2015 "Perceptually Motivated Benchmark for Video
                   ///< Matting"
  double p99 = 0;  ///< the value that this share of values does not exceed
  double max = 0;
  std::int64_t mismatches = 0;  ///< values
};

/// `now` and `next` are the same channels of two frames; in each, `b` is the truth. Sums in double,
/// in a fixed order. `clip` is that of CompareOptions. Throws Error as compare() does, and for
/// different channels.
Flicker flicker(std::span<const ComparedChannel> now, std::span<const ComparedChannel> next,
                const std::optional<double>& clip = {});

/// "0.0012, RMS 0.004, 99% 0.02, max 0.3".
std::string to_text(const Flicker& flicker);

}  // namespace limpid

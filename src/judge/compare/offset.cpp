#include "judge/compare/offset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "limpid/core/error.h"

#include "judge/compare/compared_channels.h"
#include "judge/compare/number_text.h"

namespace limpid {
namespace {

constexpr float kEnough = 0.5f;
constexpr const char* kNames[] = {"R", "G", "B"};

// Counts over some lookups.
struct Tally {
  std::int64_t wet = 0, rejected = 0, accepted = 0, mismatches = 0;
  std::vector<double> offsets;

  void add(const Tally& other) {
    wet += other.wet;
    rejected += other.rejected;
    accepted += other.accepted;
    mismatches += other.mismatches;
    offsets.insert(offsets.end(), other.offsets.begin(), other.offsets.end());
  }

  void mismatch() {
    ++mismatches;
    offsets.push_back(std::numeric_limits<double>::infinity());
  }

  OffsetErrors errors() {
    OffsetErrors result;
    result.wet = wet;
    result.measured = static_cast<std::int64_t>(offsets.size());
    result.mismatches = mismatches;
    if (wet > 0) {
      result.wrongly_rejected = static_cast<double>(rejected) / static_cast<double>(wet);
      result.wrongly_accepted = static_cast<double>(accepted) / static_cast<double>(wet);
    }
    if (offsets.empty()) return result;
    std::sort(offsets.begin(), offsets.end());
    const auto percent = [&](std::size_t p) {
      return offsets[(offsets.size() * p + 99) / 100 - 1];
    };
    result.median = percent(50);
    result.p95 = percent(95);
    result.max = offsets.back();
    return result;
  }
};

void check(const OffsetPictures& pictures) {
  if (pictures.display.width <= 0 || pictures.display.height <= 0) {
    throw Error("offset: a display of " + std::to_string(pictures.display.width) + "x" +
                std::to_string(pictures.display.height) + ": expected at least 1x1");
  }
  std::vector<ComparedChannel> same{{"confidence", pictures.surface_depth, pictures.confidence}};
  for (std::size_t c = 0; c < 3; ++c) {
    const OffsetChannel& channel = pictures.channels[c];
    const std::string name = std::string("stmap of ") + kNames[c];
    same.push_back({name, channel.u, channel.v});
    same.push_back({name, channel.true_u, channel.true_v});
    same.push_back({std::string("visible of ") + kNames[c], channel.visible, channel.visible});
  }
  check_compared(same);
}

Tally tally(const OffsetPictures& pictures, const OffsetChannel& channel) {
  Tally result;
  const Rect window = pictures.confidence.window;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const float surface = pictures.surface_depth.at(x, y);
      if (surface == std::numeric_limits<float>::infinity()) continue;
      ++result.wet;
      const float confidence = pictures.confidence.at(x, y), visible = channel.visible.at(x, y);
      if (!std::isfinite(surface) || !std::isfinite(confidence) || !std::isfinite(visible)) {
        result.mismatch();
        continue;
      }
      const bool accepted = confidence >= kEnough, there = visible >= kEnough;
      result.rejected += there && !accepted;
      result.accepted += accepted && !there;
      if (!accepted || !there) continue;
      const double across = double{channel.u.at(x, y)} - double{channel.true_u.at(x, y)};
      const double up = double{channel.v.at(x, y)} - double{channel.true_v.at(x, y)};
      const double offset =
          std::hypot(across * pictures.display.width, up * pictures.display.height);
      if (std::isfinite(offset)) {
        result.offsets.push_back(offset);
      } else {
        result.mismatch();
      }
    }
  }
  return result;
}

std::string percent_text(double share) { return number_text(100 * share) + "%"; }

std::string line(const OffsetErrors& errors) {
  if (errors.wet == 0) return "nothing is wet";
  return "median " + number_text(errors.median) + ", 95% " + number_text(errors.p95) + ", max " +
         number_text(errors.max) + " pixels, of " + std::to_string(errors.measured) +
         " lookups; wrongly rejected " + percent_text(errors.wrongly_rejected) +
         ", wrongly accepted " + percent_text(errors.wrongly_accepted) + " of " +
         std::to_string(errors.wet);
}

}  // namespace

OffsetComparison offset_errors(const OffsetPictures& pictures) {
  check(pictures);
  OffsetComparison result;
  Tally all;
  for (std::size_t c = 0; c < 3; ++c) {
    Tally one = tally(pictures, pictures.channels[c]);
    all.add(one);
    result.channels[c] = one.errors();
  }
  result.overall = all.errors();
  return result;
}

std::string to_text(const OffsetComparison& comparison) {
  std::string text = "  Offset = " + line(comparison.overall) + "\n";
  for (std::size_t c = 0; c < 3 && comparison.overall.wet > 0; ++c) {
    text += std::string("    ") + kNames[c] + "  " + line(comparison.channels[c]) + "\n";
  }
  if (comparison.overall.mismatches > 0) {
    text += "  " + std::to_string(comparison.overall.mismatches) +
            " lookups are NaN or inf where they count\n";
  }
  return text;
}

}  // namespace limpid

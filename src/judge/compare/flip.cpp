#include "judge/compare/flip.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "limpid/core/error.h"

#include "judge/compare/error_map_of.h"
#include "judge/compare/seen.h"

namespace limpid {
namespace {

// --- the difference of what is seen, Andersson et al. 2020 ---------------------------------------

constexpr float kColorPower = 0.7f;
constexpr float kFeaturePower = 0.5f;
// Color errors up to this share of the largest get this share of the range.
constexpr float kKnee = 0.4f, kKneeError = 0.95f;

float hyab(float l, float a, float b) { return std::abs(l) + std::sqrt(a * a + b * b); }

// Pure green and pure blue lie farthest apart.
float largest_color_error() {
  const auto green = hunt_lab({0, 1, 0}), blue = hunt_lab({0, 0, 1});
  const auto apart = [&](std::size_t c) { return static_cast<float>(green[c] - blue[c]); };
  return std::pow(hyab(apart(0), apart(1), apart(2)), kColorPower);
}

Grid<float> seen_difference(const Seen& a, const Seen& b) {
  const float largest = largest_color_error(), knee = kKnee * largest;
  const float below = kKneeError / knee, above = (1 - kKneeError) / (largest - knee);
  Grid<float> result(a.edges.size());
  for (std::size_t i = 0; i < result.count(); ++i) {
    const auto apart = [&](std::size_t c) { return a.lab[c][i] - b.lab[c][i]; };
    const float color = std::pow(hyab(apart(0), apart(1), apart(2)), kColorPower);
    const float color_error = color < knee ? below * color : kKneeError + above * (color - knee);
    const float feature =
        std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
    const float feature_error = std::pow(feature / std::sqrt(2.0f), kFeaturePower);
    result[i] = std::min(std::pow(std::min(color_error, 1.0f), 1 - feature_error), 1.0f);
  }
  return result;
}

ColorGrid mapped(const ColorGrid& color, const std::function<float(float)>& map) {
  ColorGrid result = color;
  for (Grid<float>& grid : result) {
    for (std::size_t i = 0; i < grid.count(); ++i) grid[i] = map(grid[i]);
  }
  return result;
}

// --- exposures, Andersson et al. 2021 -----------------------------------------------------------

// (n2 x^2 + n1 x) / (d2 x^2 + d1 x + d0): Narkowicz 2015, of .6 x.
struct Tone {
  static constexpr double n2 = 0.36 * 2.51, n1 = 0.6 * 0.03, d2 = 0.36 * 2.43, d1 = 0.6 * 0.59,
                          d0 = 0.14;
  // Clipped long before, and far from the largest float.
  static constexpr float kClipped = 1e4f;

  static float of(float x) {
    const double v = std::clamp(x, 0.0f, kClipped);
    return static_cast<float>(std::min((n2 * v * v + n1 * v) / (d2 * v * v + d1 * v + d0), 1.0));
  }
  static double inverse(double tone) {
    const double a = n2 - tone * d2, b = n1 - tone * d1, c = -tone * d0;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
  }
};

constexpr double kShownTone = 0.85;  // of the pixel for which an exposure is made
constexpr double kMaxStops = 24;

}  // namespace

ErrorMap flip(const ColorPair& pictures, const Observer& observer) {
  const Eye eye(observer);
  const CleanPair pair = clean(pictures);
  const auto shown = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
  return error_map_of(
      seen_difference(eye.look_at(mapped(pair.a, shown)), eye.look_at(mapped(pair.b, shown))),
      pair);
}

Exposures exposures_of(const ColorViews& reference) {
  const CleanPair pair = clean({reference, reference});
  std::vector<double> values(pair.b[0].count());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto lit = [&](std::size_t c) { return std::max(pair.b[c][i], 0.0f); };
    values[i] = luminance(lit(0), lit(1), lit(2));
  }
  const double brightest = *std::max_element(values.begin(), values.end());
  if (brightest == 0) return {};
  // For an even number of pixels, the mean of the two in the middle.
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double upper = *middle;
  const double lower = values.size() % 2 == 1 ? upper : *std::max_element(values.begin(), middle);
  const double median = std::max(0.5 * (lower + upper), brightest * std::exp2(-kMaxStops));
  Exposures exposures;
  exposures.start = std::log2(Tone::inverse(kShownTone) / brightest);
  exposures.stop = std::log2(Tone::inverse(kShownTone) / median);
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

ErrorMap hdr_flip(const ColorPair& pictures, const Observer& observer) {
  return hdr_flip(pictures, exposures_of(pictures.b), observer);
}

ErrorMap hdr_flip(const ColorPair& pictures, const Exposures& exposures, const Observer& observer) {
  const auto& [start, stop, count] = exposures;
  if (!(std::abs(start) <= 1000 && std::abs(stop) <= 1000 && count >= 2 && count <= 1000)) {
    throw Error("hdr_flip: " + std::to_string(count) + " exposures from " + std::to_string(start) +
                " to " + std::to_string(stop) +
                " stops: expected 2 ... 1000 within -1000 ... 1000");
  }
  const Eye eye(observer);
  const CleanPair pair = clean(pictures);
  Grid<float> worst(pair.window.size());
  for (int e = 0; e < count; ++e) {
    const double gain = std::exp2(std::lerp(start, stop, e / double(count - 1)));
    const auto shown = [&](float v) { return Tone::of(static_cast<float>(gain * v)); };
    const Grid<float> error =
        seen_difference(eye.look_at(mapped(pair.a, shown)), eye.look_at(mapped(pair.b, shown)));
    for (std::size_t i = 0; i < worst.count(); ++i) worst[i] = std::max(worst[i], error[i]);
  }
  return error_map_of(worst, pair);
}

}  // namespace limpid

#include "judge/compare/compare.h"

#include <algorithm>
#include <cmath>

#include "limpid/core/error.h"

#include "judge/compare/compared_channels.h"

namespace limpid {
namespace {

constexpr std::size_t kOffenders = 5;

void check_options(const CompareOptions& options) {
  const auto check = [](const char* name, double value, double highest) {
    if (value >= 0 && value <= highest) return;
    throw Error(std::string("compare.") + name + " = " + std::to_string(value) +
                ": expected 0 ... " + std::to_string(highest));
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  check("per_pixel", options.tolerance.per_pixel, kInfinity);
  check("allowed_percent", options.tolerance.allowed_percent, 100);
  check("hard_limit", options.tolerance.hard_limit, kInfinity);
  if (!(options.epsilon > 0 && std::isfinite(options.epsilon))) {
    throw Error("compare.epsilon = " + std::to_string(options.epsilon) + ": expected above 0");
  }
  if (options.clip && !std::isfinite(*options.clip)) {
    throw Error("compare.clip = " + std::to_string(*options.clip) + ": expected a finite number");
  }
}

std::string to_string(const Rect& r) {
  return std::to_string(r.width()) + "x" + std::to_string(r.height()) + " at (" +
         std::to_string(r.x0) + ", " + std::to_string(r.y0) + ")";
}

// The running sums of one channel.
struct Sums {
  double absolute = 0, squared = 0, relative = 0;
};

// Visits the pixels once; the percentiles come at the end, from all differences.
class Comparing {
 public:
  Comparing(std::span<const ComparedChannel> channels, const CompareOptions& options)
      : channels_(channels),
        options_(options),
        sums_(channels.size()),
        pixels_(channels[0].a.window.area()),
        differences_(channels.size() * static_cast<std::size_t>(pixels_)) {
    result_.window = channels[0].a.window;
    result_.options = options;
    result_.channels.resize(channels.size());
    for (const ComparedChannel& channel : channels) result_.names.push_back(channel.name);
  }

  Comparison run() {
    const Rect window = result_.window;
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x, ++index_) pixel(x, y);
    }
    finish();
    return std::move(result_);
  }

 private:
  void pixel(int x, int y) {
    double largest = -1;
    Offender here{x, y, 0, 0, 0};
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const float a = clipped(channels_[c].a.at(x, y)), b = clipped(channels_[c].b.at(x, y));
      const double d = difference(a, b);
      const Offender place{x, y, static_cast<int>(c), a, b};
      add(result_.channels[c], sums_[c], d, place);
      differences_[c * static_cast<std::size_t>(pixels_) + index_] = d;
      if (d > largest) {
        largest = d;
        here = place;
      }
    }
    if (largest > options_.tolerance.per_pixel) {
      ++result_.overall.over;
      if (result_.offenders.size() < kOffenders) result_.offenders.push_back(here);
    }
  }

  float clipped(float value) const {
    return options_.clip && value > *options_.clip ? static_cast<float>(*options_.clip) : value;
  }

  void add(Metrics& metrics, Sums& sums, double d, const Offender& place) const {
    if (d == 0) {
      metrics.both_nan += std::isnan(place.a);
      return;
    }
    const double b = place.b;
    sums.absolute += d;
    sums.squared += d * d;
    sums.relative += std::isinf(d) ? d : d * d / (b * b + options_.epsilon);
    metrics.mismatches += std::isinf(d);
    metrics.over += d > options_.tolerance.per_pixel;
    if (d > metrics.max) {
      metrics.max = d;
      metrics.max_at = place;
    }
  }

  void finish() {
    Metrics& overall = result_.overall;
    Sums all;
    double* values = differences_.data();
    const double count = static_cast<double>(pixels_);
    for (std::size_t c = 0; c < channels_.size(); ++c, values += pixels_) {
      Metrics& metrics = result_.channels[c];
      finish(metrics, sums_[c], count, {values, static_cast<std::size_t>(pixels_)});
      all.absolute += sums_[c].absolute;
      all.squared += sums_[c].squared;
      all.relative += sums_[c].relative;
      overall.mismatches += metrics.mismatches;
      overall.both_nan += metrics.both_nan;
      if (metrics.max > overall.max) {
        overall.max = metrics.max;
        overall.max_at = metrics.max_at;
      }
    }
    finish(overall, all, count * static_cast<double>(channels_.size()), differences_);
  }

  void finish(Metrics& metrics, const Sums& sums, double count, std::span<double> values) const {
    metrics.mean = sums.absolute / count;
    metrics.rmse = std::sqrt(sums.squared / count);
    metrics.rel_mse = sums.relative / count;
    metrics.psnr = -20 * std::log10(metrics.rmse);
    metrics.over_percent = 100 * static_cast<double>(metrics.over) / static_cast<double>(pixels_);
    // Each search leaves the smaller values in front, for the next search.
    const std::size_t r99_99 = rank(values.size(), 9999), r99 = rank(values.size(), 9900);
    metrics.p99_99 = smallest(values, r99_99);
    metrics.p99 = smallest(values.first(r99_99), r99);
    metrics.p50 = smallest(values.first(r99), rank(values.size(), 5000));
  }

  // Number of values that are at least `share`/10000 of `count`.
  static std::size_t rank(std::size_t count, std::size_t share) {
    return (count * share + 9999) / 10000;
  }

  static double smallest(std::span<double> values, std::size_t rank) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  }

  std::span<const ComparedChannel> channels_;
  CompareOptions options_;
  std::vector<Sums> sums_;
  std::int64_t pixels_;
  std::vector<double> differences_;  // channel by channel
  std::size_t index_ = 0;            // of the pixel
  Comparison result_;
};

}  // namespace

void check_compared(std::span<const ComparedChannel> channels) {
  if (channels.empty()) throw Error("nothing to compare: expected at least one channel");
  const Rect window = channels[0].a.window;
  if (window.empty()) throw Error("nothing to compare: expected at least 1x1 pixels");
  for (const ComparedChannel& channel : channels) {
    for (const Rect& other : {channel.a.window, channel.b.window}) {
      if (other == window) continue;
      throw Error("channel " + channel.name + ": " + to_string(window) + " cannot be compared to " +
                  to_string(other) + ": expected the same pixels");
    }
  }
}

double difference(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double d = std::abs(double{a} - double{b});
  return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

Comparison compare(std::span<const ComparedChannel> channels, const CompareOptions& options) {
  check_options(options);
  check_compared(channels);
  return Comparing(channels, options).run();
}

bool within(const Comparison& comparison) {
  const Metrics& all = comparison.overall;
  const Tolerance& tolerance = comparison.options.tolerance;
  return all.mismatches == 0 && all.over_percent <= tolerance.allowed_percent &&
         all.max <= tolerance.hard_limit;
}

}  // namespace limpid

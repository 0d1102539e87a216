#include "judge/compare/temporal.h"

#include <algorithm>
#include <cmath>

#include "limpid/core/error.h"

#include "judge/compare/compared_channels.h"
#include "judge/compare/number_text.h"

namespace limpid {
namespace {

// a - b, or 0 where difference() is 0; +inf for a mismatch.
double signed_difference(float a, float b) {
  const double d = difference(a, b);
  return d == 0 || std::isinf(d) ? d : double{a} - double{b};
}

double change(double now, double next) {
  return std::isinf(now) || std::isinf(next) ? std::numeric_limits<double>::infinity()
                                             : std::abs(next - now);
}

void check_same(std::span<const ComparedChannel> now, std::span<const ComparedChannel> next) {
  check_compared(now);
  check_compared(next);
  if (now.size() != next.size()) {
    throw Error("flicker of " + std::to_string(now.size()) + " and " + std::to_string(next.size()) +
                " channels: expected the same in both frames");
  }
  for (std::size_t c = 0; c < now.size(); ++c) {
    const ComparedChannel across[] = {{now[c].name, now[c].a, next[c].a}};
    check_compared(across);
    if (now[c].name == next[c].name) continue;
    throw Error("flicker of the channels " + now[c].name + " and " + next[c].name +
                ": expected the same in both frames");
  }
}

}  // namespace

Flicker flicker(std::span<const ComparedChannel> now, std::span<const ComparedChannel> next,
                const std::optional<double>& clip) {
  check_same(now, next);
  if (clip && !std::isfinite(*clip)) {
    throw Error("flicker: clip at " + number_text(*clip) + ": expected a finite number");
  }
  const float most = clip ? static_cast<float>(*clip) : HUGE_VALF;
  const auto error = [most](const ComparedChannel& channel, int x, int y) {
    const float a = channel.a.at(x, y), b = channel.b.at(x, y);
    return signed_difference(a > most ? most : a, b > most ? most : b);  // NaN stays
  };
  const Rect window = now[0].a.window;
  std::vector<double> values;
  values.reserve(now.size() * static_cast<std::size_t>(window.area()));
  Flicker result;
  double squares = 0;
  for (std::size_t c = 0; c < now.size(); ++c) {
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        const double d = change(error(now[c], x, y), error(next[c], x, y));
        values.push_back(d);
        result.mean += d;
        squares += d * d;
        result.max = std::max(result.max, d);
        result.mismatches += std::isinf(d);
      }
    }
  }
  const auto count = static_cast<double>(values.size());
  result.mean /= count;
  result.rms = std::sqrt(squares / count);
  const auto place = static_cast<std::ptrdiff_t>((values.size() * 99 + 99) / 100 - 1);
  std::nth_element(values.begin(), values.begin() + place, values.end());
  result.p99 = values[static_cast<std::size_t>(place)];
  return result;
}

std::string to_text(const Flicker& flicker) {
  return number_text(flicker.mean) + ", RMS " + number_text(flicker.rms) + ", 99% " +
         number_text(flicker.p99) + ", max " + number_text(flicker.max);
}

}  // namespace limpid

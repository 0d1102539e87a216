#include "run/shared_bytes.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace limpid {
namespace {

/// The pixels as lines of samples, by their first bytes: the stride of lines is larger than that of
/// samples.
struct Lines {
  std::int64_t first;         ///< first byte of all
  std::int64_t line, sample;  ///< strides, 0 or more
  std::int64_t lines, samples;
  std::int64_t bytes;  ///< of a sample

  std::int64_t length() const { return (samples - 1) * sample + bytes; }
  std::int64_t end() const { return first + (lines - 1) * line + length(); }
};

Lines lines_of(const HostOutput& view, const Rect& pixels) {
  const std::int64_t width = pixels.width(), height = pixels.height();
  const std::int64_t x = view.x_stride, y = view.y_stride;
  std::int64_t first = static_cast<std::int64_t>(reinterpret_cast<std::intptr_t>(view.data)) +
                       (pixels.x0 - view.window.x0) * x + (pixels.y0 - view.window.y0) * y;
  first += std::min<std::int64_t>(0, (width - 1) * x) + std::min<std::int64_t>(0, (height - 1) * y);
  const std::int64_t bytes = bytes_of(view.sample), across = std::abs(x), down = std::abs(y);
  if (height == 1) return {first, 0, across, 1, width, bytes};
  if (width == 1) return {first, 0, down, 1, height, bytes};
  if (down < across) return {first, across, down, width, height, bytes};
  return {first, down, across, height, width, bytes};
}

/// The step of a progression from 0 in which `a` lies, -1 before the first.
std::int64_t step_of(std::int64_t a, std::int64_t step) { return a >= 0 ? a / step : -1; }

/// The steps first ... last of a progression from 0 whose `length` bytes overlap `from` ... `end`.
struct Steps {
  std::int64_t first, last;
};
Steps steps_between(std::int64_t step, std::int64_t count, std::int64_t length, std::int64_t from,
                    std::int64_t end) {
  if (step == 0) return {0, from < length && end > 0 ? 0 : -1};
  return {std::max<std::int64_t>(0, step_of(from - length, step) + 1),
          std::min(count - 1, step_of(end - 1, step))};
}

/// Whether two lines that begin this many bytes apart share a byte.
bool lines_meet(const Lines& a, const Lines& b, std::int64_t apart) {
  if (a.sample == b.sample) {
    // Only the distance of two samples counts: from the last of `a` before the first of `b`, to the
    // reverse.
    const std::int64_t near = apart - (a.samples - 1) * a.sample;
    const Steps steps =
        steps_between(a.sample, a.samples + b.samples - 1, b.bytes, -near, a.bytes - near);
    return steps.first <= steps.last;
  }
  for (std::int64_t i = 0; i < a.samples; ++i) {
    const std::int64_t at = i * a.sample - apart;
    const Steps steps = steps_between(b.sample, b.samples, b.bytes, at, at + a.bytes);
    if (steps.first <= steps.last) return true;
  }
  return false;
}

}  // namespace

bool shares_bytes(const HostOutput& view, const Rect& pixels) {
  const Lines lines = lines_of(view, pixels);
  if (lines.samples > 1 && lines.sample < lines.bytes) return true;
  return lines.lines > 1 && lines.line < lines.length();
}

bool share_bytes(const HostOutput& a, const HostOutput& b, const Rect& pixels) {
  const Lines from = lines_of(a, pixels), to = lines_of(b, pixels);
  if (from.end() <= to.first || to.end() <= from.first) return false;
  for (std::int64_t i = 0; i < from.lines; ++i) {
    const std::int64_t at = from.first + i * from.line - to.first;
    const Steps steps = steps_between(to.line, to.lines, to.length(), at, at + from.length());
    for (std::int64_t j = steps.first; j <= steps.last; ++j) {
      if (lines_meet(from, to, j * to.line - at)) return true;
    }
  }
  return false;
}

}  // namespace limpid

#include "complete/mirror_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace limpid {
namespace {

/// The columns of a strip of a reflection.
class Columns {
 public:
  Columns(const Frame& frame, const View<const float>& valid, const View<float>& depth)
      : valid_(valid), depth_(depth), most_(std::max(2, depth.window.height() / kShare)) {
    for (int c = 0; c < 3; ++c) {
      color_[c] = frame.plane(plane_after(PlaneId::kReflectionR, c));
    }
  }

  /// Grows the columns from `begin` to before `end`, at most kStrip, row by row.
  void grow(int begin, int end) const {
    const Rect& window = depth_.window;
    std::array<int, kStrip> grown_to;
    grown_to.fill(window.y0 - 1);
    for (int y = window.y0; y + 1 < window.y1; ++y) {
      for (int x = begin; x < end; ++x) {
        int& last = grown_to[static_cast<std::size_t>(x - begin)];
        const bool here = is_known(x, y);
        if (here == is_known(x, y + 1) || y <= last) continue;
        if (here) {
          last = grown(x, y, 1);
        } else {
          grown(x, y + 1, -1);
        }
      }
    }
  }
  static constexpr int kStrip = 32;

 private:
  /// The picture's height over the greatest growth.
  static constexpr int kShare = 64;
  /// A color differs clearly from another one if the difference is this share of their sum, and is
  /// kept while it is off by less than a quarter of that difference.
  static constexpr float kClear = 0.5f, kKept = 0.25f;

  /// Grows the known texel at the row y by steps of 1 or -1; the last row grown.
  int grown(int x, int y, int step) const {
    if (!(valid_.at(x, y) >= 0.5f)) return y;
    const int beyond = y + step * most_;
    if (beyond < depth_.window.y0 || beyond >= depth_.window.y1 || is_known(x, beyond)) return y;
    const float difference = differ(x, y, beyond);
    if (!(difference > kClear * (light_at(x, y) + light_at(x, beyond)))) return y;
    int last = y;
    for (int at = y + step; at != beyond; at += step) {
      const bool free = !is_known(x, at) && valid_.at(x, at) >= 0.5f;
      if (!(free && differ(x, y, at) < kKept * difference)) break;
      depth_.at(x, at) = depth_.at(x, y);
      last = at;
    }
    return last;
  }
  bool is_known(int x, int y) const { return std::isfinite(depth_.at(x, y)); }
  float light_at(int x, int y) const {
    float sum = 0;
    for (const auto& channel : color_) sum += std::abs(channel.at(x, y));
    return sum;
  }
  float differ(int x, int y, int other) const {
    float sum = 0;
    for (const auto& channel : color_) sum += std::abs(channel.at(x, y) - channel.at(x, other));
    return sum;
  }

  View<const float> color_[3], valid_;
  View<float> depth_;
  int most_;
};

}  // namespace

void grow_to_outlines(const Frame& frame, const View<const float>& valid, const View<float>& depth,
                      Executor& executor) {
  constexpr int kStrip = Columns::kStrip;
  const Rect& window = depth.window;
  const Columns columns(frame, valid, depth);
  run_each(executor, (window.width() + kStrip - 1) / kStrip, [&](int index) {
    const int begin = window.x0 + index * kStrip;
    columns.grow(begin, std::min(begin + kStrip, window.x1));
  });
}

}  // namespace limpid

#pragma once
#include "run/source.h"

/// Bilinear filtering for lanes. For inclusion by lanes_target.cpp alone.

namespace limpid::HWY_NAMESPACE {

/// The place of a bilinear lookup: the upper left of four texels, and the weights of the right and
/// the lower texels. Clamped to the window, so that all four texels lie inside. `At` is Places for
/// lookups that are made later, else VI.
template <class At>
struct Spot {
  At upper_left;
  Lane u, v;

  Spot() = default;
  /// For a vector whose first pixel is (x, y), by shifts in texels; NaN becomes the lower end.
  LIMPID_LANES_INLINE Spot(const Source& s, int x, int y, Vec2<Lane> shift) {
    const Lane first(s.window.x0 - x), iota(hn::Iota(kD, 0.0f));
    const VI column = along(first - iota, s.width(), shift.x, u);
    const VI row = along(Lane(s.window.y0 - y), s.height(), shift.y, v);
    const VI own = count_from(x - s.window.x0);
    upper_left = At(s.index(hn::Add(own, column), hn::Add(hn::Set(kDI, y - s.window.y0), row)));
  }
  /// By texels from the centre of the first texel.
  LIMPID_LANES_INLINE Spot(const Source& s, Vec2<Lane> at) {
    const VI column = along(Lane(0), s.width(), at.x, u), row = along(Lane(0), s.height(), at.y, v);
    upper_left = At(s.index(column, row));
  }

 private:
  /// Relative to the pixel itself; `first` is the begin of the window, relative to it.
  static LIMPID_LANES_INLINE VI along(Lane first, int count, Lane shift, Lane& weight) {
    const Lane last = first + Lane(count - 1);
    const Lane at = min(max(shift, first), last);
    const Lane whole = count > 1 ? min(floor(at), last - Lane(1)) : first;
    weight = at - whole;
    return whole_of(whole);
  }
};

/// Index of the texel nearest to the shifted place of each pixel.
LIMPID_LANES_INLINE VI nearest_place(const Source& s, int x, int y, Vec2<Lane> shift) {
  const Lane half(0.5), iota(hn::Iota(kD, 0.0f));
  const auto along = [&](Lane first, int count, Lane by) LIMPID_LANES_LAMBDA {
    return whole_of(min(max(floor(by + half), first), first + Lane(count - 1)) - first);
  };
  return s.index(along(Lane(s.window.x0 - x) - iota, s.width(), shift.x),
                 along(Lane(s.window.y0 - y), s.height(), shift.y));
}

/// Whether the two taps of a row are adjacent in memory.
LIMPID_LANES_INLINE bool has_pairs(const Source& s) { return s.x_stride == 1 && s.width() > 1; }

/// The four texels at (x, y) ... (x + 1, y + 1) of a window, for any channel of that window. Beyond
/// its edge the outermost texels repeat: both taps of a pair are then the same texel.
struct QuadPairs {
  VI upper, lower;
  Mask before, after;  ///< where a pair lies before the window, or after it

  QuadPairs() = default;
  /// Requires has_pairs(s).
  LIMPID_LANES_INLINE QuadPairs(const Source& s, VI x, VI y) {
    const int first = s.window.x0, last = s.window.x1 - 2;
    before = {hn::RebindMask(kD, hn::Lt(x, hn::Set(kDI, first)))};
    after = {hn::RebindMask(kD, hn::Gt(x, hn::Set(kDI, last)))};
    const VI across = hn::Sub(clamp(x, first, last), hn::Set(kDI, first));
    const auto row = [&](VI at) LIMPID_LANES_LAMBDA {
      const VI down = clamp(at, s.window.y0, s.window.y1 - 1);
      return s.index(across, hn::Sub(down, hn::Set(kDI, s.window.y0)));
    };
    upper = row(y);
    lower = row(hn::Add(y, hn::Set(kDI, 1)));
  }

  LIMPID_LANES_INLINE Four<Lane> read(const float* data) const {
    const Pair top = fetch_pairs(data, upper), bottom = fetch_pairs(data, lower);
    return {select(after, top.right, top.left), select(before, top.left, top.right),
            select(after, bottom.right, bottom.left), select(before, bottom.left, bottom.right)};
  }
};

/// Lookups in N channels of the same layout. A window of one column or one row uses the same texel
/// twice.
template <int N, bool kPairs, class At>
LIMPID_LANES_INLINE void sample(const Source* sources, const Spot<At>& spot, Lane* out) {
  const Source& s = sources[0];
  const int right = s.width() > 1 ? s.x_stride : 0, down = s.height() > 1 ? s.y_stride : 0;
  const auto row = [&](const float* data) LIMPID_LANES_LAMBDA {
    if constexpr (kPairs) {
      const Pair pair = fetch_pairs(data, spot.upper_left);
      return lerp(pair.left, pair.right, spot.u);
    } else {
      return lerp(fetch(data, spot.upper_left), fetch(data + right, spot.upper_left), spot.u);
    }
  };
  for (int c = 0; c < N; ++c) {
    out[c] = lerp(row(sources[c].data), row(sources[c].data + down), spot.v);
  }
}

}  // namespace limpid::HWY_NAMESPACE

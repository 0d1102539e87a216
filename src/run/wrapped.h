#pragma once
#include "run/source.h"

/// Bilinear filtering of textures, for lanes. For inclusion by lanes_target.cpp alone.

namespace limpid::HWY_NAMESPACE {

/// 0 for an infinite position, so that every tap lies in the texture.
LIMPID_LANES_INLINE Lane fraction(Lane x) {
  const Lane f = x - floor(x);
  return select(f >= Lane(0), f, Lane(0));
}

/// Four taps on a texture that repeats; positions in periods. Or that repeats in x alone: positions
/// in y are 0 ... 1 then, and taps end at its edges.
template <bool kBoth>
struct WrappedSpot {
  VI x, y, x1, y1;
  Lane u, v;

  LIMPID_LANES_INLINE WrappedSpot(int width, int height, Vec2<Lane> periods) {
    const Lane at_x = fraction(periods.x) * Lane(width) - Lane(0.5);
    const Lane at_y = (kBoth ? fraction(periods.y) : periods.y) * Lane(height) - Lane(0.5);
    const Lane whole_x = floor(at_x), whole_y = floor(at_y);
    u = at_x - whole_x;
    v = at_y - whole_y;
    x = wrapped(whole_of(whole_x), width);
    y = whole_of(whole_y);
    x1 = wrapped(hn::Add(x, hn::Set(kDI, 1)), width);
    y1 = hn::Add(y, hn::Set(kDI, 1));
    y = kBoth ? wrapped(y, height) : clamp(y, 0, height - 1);
    y1 = kBoth ? wrapped(hn::Add(y, hn::Set(kDI, 1)), height) : clamp(y1, 0, height - 1);
  }

 private:
  /// For -size <= i < 2 size.
  static LIMPID_LANES_INLINE VI wrapped(VI i, int size) {
    const VI n = hn::Set(kDI, size);
    const VI up = hn::IfThenElse(hn::Lt(i, hn::Zero(kDI)), hn::Add(i, n), i);
    return hn::IfThenElse(hn::Lt(up, n), up, hn::Sub(up, n));
  }
};

/// Where bilinear filtering looks in Texture::bytes.
struct BytesSpot {
  Places upper_left;
  Lane u, v;

  BytesSpot() = default;
  LIMPID_LANES_INLINE BytesSpot(int width, int height, Vec2<Lane> periods) {
    const VI x = along(width, periods.x, u), y = along(height, periods.y, v);
    upper_left = Places(hn::Add(hn::Mul(y, hn::Set(kDI, width + 1)), x));
  }

 private:
  /// From the middle of the last texel, which comes before the first one, on.
  static LIMPID_LANES_INLINE VI along(int size, Lane periods, Lane& weight) {
    const Lane at = fraction(periods) * Lane(size) - Lane(0.5), whole = floor(at);
    weight = at - whole;
    const VI i = whole_of(whole);
    return hn::Add(i, hn::And(hn::ShiftRight<31>(i), hn::Set(kDI, size)));
  }
};

/// One fetch for all three channels.
LIMPID_LANES_INLINE Rgb<Lane> bytes_rgb(const std::uint32_t* texels, int width,
                                        const BytesSpot& spot) {
  const float* data = reinterpret_cast<const float*>(texels);
  const Pair upper = fetch_pairs(data, spot.upper_left);
  const Pair lower = fetch_pairs(data + width + 1, spot.upper_left);
  const VI corners[4] = {hn::BitCast(kDI, upper.left.v), hn::BitCast(kDI, upper.right.v),
                         hn::BitCast(kDI, lower.left.v), hn::BitCast(kDI, lower.right.v)};
  const VI byte = hn::Set(kDI, 255);
  const auto mixed = [&](auto channel) LIMPID_LANES_LAMBDA {
    const auto at = [&](int k) LIMPID_LANES_LAMBDA {
      return Lane(hn::ConvertTo(kD, channel(corners[k])));
    };
    const Lane value = lerp(lerp(at(0), at(1), spot.u), lerp(at(2), at(3), spot.u), spot.v);
    return value * Lane(1.0 / 255);
  };
  return {mixed([&](VI c) LIMPID_LANES_LAMBDA { return hn::And(c, byte); }),
          mixed([&](VI c) LIMPID_LANES_LAMBDA { return hn::And(hn::ShiftRight<8>(c), byte); }),
          mixed([&](VI c) LIMPID_LANES_LAMBDA { return hn::ShiftRight<16>(c); })};
}

template <bool kBoth>
LIMPID_LANES_INLINE Rgb<Lane> wrapped_rgb(const Texture& texture, Vec2<Lane> periods) {
  const Rect& window = texture.channels[0].window;
  const int width = window.x1 - window.x0, height = window.y1 - window.y0;
  const WrappedSpot<kBoth> spot(width, height, periods);
  Lane value[3];
  for (int c = 0; c < 3; ++c) {
    const Source s(texture.channels[c], 0);
    const auto at = [&](VI x, VI y) { return s.gather(s.index(x, y)); };
    value[c] = lerp(lerp(at(spot.x, spot.y), at(spot.x1, spot.y), spot.u),
                    lerp(at(spot.x, spot.y1), at(spot.x1, spot.y1), spot.u), spot.v);
  }
  return {value[0], value[1], value[2]};
}

}  // namespace limpid::HWY_NAMESPACE

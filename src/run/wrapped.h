#pragma once
#include "limpid/core/texture_levels.h"

#include "run/source.h"

/// Bilinear filtering of textures, for lanes. For inclusion by lanes_target.cpp alone.

namespace limpid::HWY_NAMESPACE {

/// 0 for an infinite position, so that every tap lies in the texture.
LIMPID_LANES_INLINE Lane fraction(Lane x) {
  const Lane f = x - floor(x);
  return select(f >= Lane(0), f, Lane(0));
}

/// Four taps on a texture that repeats; positions in periods. Without kBoth it repeats in x only:
/// positions in y are 0 ... 1, and taps are clamped to its edges.
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

/// The place of a bilinear lookup in Texture::bytes.
struct BytesSpot {
  Places upper_left;
  Lane u, v;

  BytesSpot() = default;
  LIMPID_LANES_INLINE BytesSpot(int width, int height, Vec2<Lane> periods) {
    const VI x = along(hn::Set(kDI, width), periods.x, u);
    const VI y = along(hn::Set(kDI, height), periods.y, v);
    upper_left = Places(hn::Add(hn::Mul(y, hn::Set(kDI, width + 1)), x));
  }

  /// Relative to the middle of the last texel, which precedes the first texel.
  static LIMPID_LANES_INLINE VI along(VI size, Lane periods, Lane& weight) {
    const Lane texels(hn::ConvertTo(kD, size));
    const Lane at = fraction(periods) * texels - Lane(0.5), whole = floor(at);
    weight = at - whole;
    const VI i = whole_of(whole);
    return hn::Add(i, hn::And(hn::ShiftRight<31>(i), size));
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

/// Levels of a texture, chosen per lane. Neighbours mostly have the same level.
struct LevelChoice {
  VI width, height, first;

  LIMPID_LANES_INLINE LevelChoice(const LevelSizes& sizes, Lane level) {
    const int lowest = static_cast<int>(least(level));
    if (lowest == static_cast<int>(greatest(level))) {
      width = hn::Set(kDI, sizes.width[lowest]);
      height = hn::Set(kDI, sizes.height[lowest]);
      first = hn::Set(kDI, sizes.first[lowest]);
    } else {
      const VI at = whole_of(level);
      width = entry(sizes.width, at);
      height = entry(sizes.height, at);
      first = entry(sizes.first, at);
    }
  }

 private:
  static LIMPID_LANES_INLINE VI entry(const std::int32_t* table, VI at) {
    return hn::BitCast(kDI, fetch(reinterpret_cast<const float*>(table), at).v);
  }
};

/// The place of a bilinear lookup in such levels.
struct LevelSpot {
  VI upper, lower;
  Lane u, v;

  LIMPID_LANES_INLINE LevelSpot(const LevelChoice& level, Vec2<Lane> periods) {
    const VI pitch = hn::Add(level.width, hn::Set(kDI, 1));
    const VI x = BytesSpot::along(level.width, periods.x, u);
    const VI y = BytesSpot::along(level.height, periods.y, v);
    upper = hn::Add(hn::Add(hn::Mul(y, pitch), x), level.first);
    lower = hn::Add(upper, pitch);
  }
};

/// Share of the levels if the pixel is `width` texels of the map wide; the rest is the map itself.
LIMPID_LANES_INLINE Lane share_of_levels(Lane width) {
  return saturate(Lane(4) * width - Lane(5.5));
}

/// The two levels for a pixel that is `width` texels of the first level wide, and the share of the
/// second: 2^k texels of the first level are one of level k. The share goes from 0 to 1 over a
/// quarter of the interval between two levels, so that most pixels read one level only.
struct LevelPair {
  Lane level, next, rest;

  LIMPID_LANES_INLINE LevelPair(const LevelSizes& sizes, Lane width) {
    const VI bias = hn::Set(kDI, 127);
    // The exponent of the float is the level.
    const VI exponent = hn::Sub(hn::ShiftRight<23>(hn::BitCast(kDI, width.v)), bias);
    const VI whole = clamp(exponent, 0, sizes.count - 1);
    const Lane part(hn::BitCast(kD, hn::ShiftLeft<23>(hn::Sub(bias, whole))));
    const Lane last(sizes.count - 1);
    level = Lane(hn::ConvertTo(kD, whole));
    next = min(level + Lane(1), last);
    const Lane between = width * part - Lane(1);
    rest = select(level < last, saturate(Lane(4) * between - Lane(1.5)), Lane(0));
  }
  LIMPID_LANES_INLINE bool one_alone() const { return !any(rest > Lane(0) && rest < Lane(1)); }
  LIMPID_LANES_INLINE Lane nearer() const { return select(rest < Lane(1), level, next); }
  LIMPID_LANES_INLINE Lane mixed(Lane finer, Lane coarser) const {
    return select(rest < Lane(1), lerp(finer, coarser, rest), coarser);
  }
};

LIMPID_LANES_INLINE Rgb<Lane> level_rgb(const std::uint32_t* texels, const LevelSpot& spot) {
  const float* data = reinterpret_cast<const float*>(texels);
  const Pair upper = fetch_pairs(data, spot.upper), lower = fetch_pairs(data, spot.lower);
  const VI corners[4] = {hn::BitCast(kDI, upper.left.v), hn::BitCast(kDI, upper.right.v),
                         hn::BitCast(kDI, lower.left.v), hn::BitCast(kDI, lower.right.v)};
  const VI low = hn::Set(kDI, 2047);
  const auto mixed = [&](auto channel, double most) LIMPID_LANES_LAMBDA {
    const auto at = [&](int k) LIMPID_LANES_LAMBDA {
      return Lane(hn::ConvertTo(kD, channel(corners[k])));
    };
    const Lane value = lerp(lerp(at(0), at(1), spot.u), lerp(at(2), at(3), spot.u), spot.v);
    return value * Lane(1 / most);
  };
  return {
      mixed([&](VI c) LIMPID_LANES_LAMBDA { return hn::And(c, low); }, 2047),
      mixed([&](VI c) LIMPID_LANES_LAMBDA { return hn::And(hn::ShiftRight<11>(c), low); }, 2047),
      mixed([&](VI c) LIMPID_LANES_LAMBDA { return hn::ShiftRight<22>(c); }, 511)};
}

/// For a pixel that is `width` texels of the first level wide.
LIMPID_LANES_INLINE Rgb<Lane> levels_rgb(const TextureLevels& levels, Lane width,
                                         Vec2<Lane> periods) {
  const LevelPair pair(levels.sizes, width);
  const auto look_up = [&](Lane level) LIMPID_LANES_LAMBDA {
    return level_rgb(levels.texels, LevelSpot(LevelChoice(levels.sizes, level), periods));
  };
  if (pair.one_alone()) return look_up(pair.nearer());
  const Rgb<Lane> finer = look_up(pair.level), coarser = look_up(pair.next);
  return {pair.mixed(finer.r, coarser.r), pair.mixed(finer.g, coarser.g),
          pair.mixed(finer.b, coarser.b)};
}

/// One of the moments.
LIMPID_LANES_INLINE Lane level_moment(const float* plane, const LevelSpot& spot) {
  const Pair upper = fetch_pairs(plane, spot.upper), lower = fetch_pairs(plane, spot.lower);
  return lerp(lerp(upper.left, upper.right, spot.u), lerp(lower.left, lower.right, spot.u), spot.v);
}

LIMPID_LANES_INLINE SlopeMoments<Lane> levels_slopes(const SlopeLevels& levels, Lane width,
                                                     Vec2<Lane> periods) {
  const LevelPair pair(levels.sizes, width);
  Lane value[TextureLevels::kMoments];
  if (pair.one_alone()) {
    const LevelSpot spot(LevelChoice(levels.sizes, pair.nearer()), periods);
    for (int c = 0; c < TextureLevels::kMoments; ++c) {
      value[c] = level_moment(levels.planes[c], spot);
    }
  } else {
    const LevelSpot finer(LevelChoice(levels.sizes, pair.level), periods);
    const LevelSpot coarser(LevelChoice(levels.sizes, pair.next), periods);
    for (int c = 0; c < TextureLevels::kMoments; ++c) {
      value[c] = pair.mixed(level_moment(levels.planes[c], finer),
                            level_moment(levels.planes[c], coarser));
    }
  }
  return {{value[0], value[1]}, {value[2], value[3], value[4]}};
}

/// Neighbours in a row are read as pairs, unless some lane wraps around between them.
template <bool kBoth>
LIMPID_LANES_INLINE Rgb<Lane> wrapped_rgb(const Texture& texture, Vec2<Lane> periods) {
  const Rect& window = texture.channels[0].window;
  const int width = window.x1 - window.x0, height = window.y1 - window.y0;
  const WrappedSpot<kBoth> spot(width, height, periods);
  const bool pairs = width > 1 && !any({hn::RebindMask(kD, hn::Lt(spot.x1, spot.x))});
  Lane value[3];
  for (int c = 0; c < 3; ++c) {
    const Source s(texture.channels[c], 0);
    if (pairs && s.x_stride == 1) {
      const Pair upper = fetch_pairs(s.data, s.index(spot.x, spot.y));
      const Pair lower = fetch_pairs(s.data, s.index(spot.x, spot.y1));
      value[c] = lerp(lerp(upper.left, upper.right, spot.u), lerp(lower.left, lower.right, spot.u),
                      spot.v);
      continue;
    }
    const auto at = [&](VI x, VI y) { return s.gather(s.index(x, y)); };
    value[c] = lerp(lerp(at(spot.x, spot.y), at(spot.x1, spot.y), spot.u),
                    lerp(at(spot.x, spot.y1), at(spot.x1, spot.y1), spot.u), spot.v);
  }
  return {value[0], value[1], value[2]};
}

}  // namespace limpid::HWY_NAMESPACE

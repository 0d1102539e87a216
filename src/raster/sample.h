#pragma once
#include "limpid/core/vec.h"

#include "raster/fragment.h"
#include "raster/raster_job.h"

/// Texture and shadow map lookups in lanes. For inclusion by raster_target.cpp alone.

namespace limpid::raster::HWY_NAMESPACE {

/// The mip level whose texel size is nearest to the pixel: log2 of the longer side of its footprint
/// in texels, rounded.
LIMPID_LANES_INLINE VI level_of(const PyramidView& texture, const Footprint& f) {
  const Lane w(texture.width), h(texture.height);
  const Lane ax = f.u_dx * w, ay = f.v_dx * h, bx = f.u_dy * w, by = f.v_dy * h;
  const Lane square = max(ax * ax + ay * ay, bx * bx + by * by);
  // floor(log2(2 square) / 2), read from the exponent; NaN becomes the first level.
  const Lane kept = min(max(Lane(2) * square, Lane(1)), Lane(1e30));
  const VI exponent = hn::Sub(hn::ShiftRight<23>(hn::BitCast(kDI, kept.v)), hn::Set(kDI, 127));
  return hn::Min(hn::ShiftRight<1>(exponent), hn::Set(kDI, texture.levels - 1));
}

struct Texel {
  Rgb<Lane> color;
  Lane alpha;
};

/// Wraps a coordinate into 0 ... 1; NaN becomes 0.
LIMPID_LANES_INLINE Lane wrapped(Lane at, Wrap wrap) {
  Lane part = at;
  if (wrap == Wrap::kRepeat) part = at - floor(at);
  if (wrap == Wrap::kMirror) {
    part = at - Lane(2) * floor(Lane(0.5) * at);
    part = min(part, Lane(2) - part);
  }
  return min(select(part > Lane(0), part, Lane(0)), Lane(1));
}

/// Bilinear lookup.
LIMPID_LANES_INLINE Texel sample(const PyramidView& texture, const Footprint& f, Wrap wrap_u,
                                 Wrap wrap_v) {
  const VI level = level_of(texture, f), one = hn::Set(kDI, 1);
  const auto size_at = [&](int size) { return hn::Max(hn::Shr(hn::Set(kDI, size), level), one); };
  const VI width = size_at(texture.width), height = size_at(texture.height);
  const VI start = hn::GatherIndex(kDI, texture.level_start, level);
  const auto place = [](Lane at, Wrap wrap, VI size, VI& low, VI& high) {
    const Lane texel = wrapped(at, wrap) * Lane(hn::ConvertTo(kD, size)) - Lane(0.5);
    const Lane whole = floor(texel);
    const VI n = hn::ConvertTo(kDI, whole.v), last = hn::Sub(size, hn::Set(kDI, 1));
    const bool repeats = wrap == Wrap::kRepeat;  // else the outermost texel continues
    const VI zero = hn::Zero(kDI), before = repeats ? last : zero, beyond = repeats ? zero : last;
    low = hn::Min(hn::IfThenElse(hn::Lt(n, zero), before, n), last);
    const VI next = hn::Add(n, hn::Set(kDI, 1));
    high = hn::IfThenElse(hn::Gt(next, last), beyond, next);
    return texel - whole;
  };
  VI x0, x1, y0, y1;
  const Lane s = place(f.u, wrap_u, width, x0, x1), t = place(f.v, wrap_v, height, y0, y1);
  const VI upper = hn::Add(start, hn::Mul(y0, width)), lower = hn::Add(start, hn::Mul(y1, width));
  alignas(64) std::int32_t at[4][kLanes];
  alignas(64) float weight[4][kLanes];
  alignas(64) float texels[4 * kLanes];
  hn::Store(hn::Add(upper, x0), kDI, at[0]);
  hn::Store(hn::Add(upper, x1), kDI, at[1]);
  hn::Store(hn::Add(lower, x0), kDI, at[2]);
  hn::Store(hn::Add(lower, x1), kDI, at[3]);
  const Lane far_s = Lane(1) - s, far_t = Lane(1) - t;
  hn::Store((far_s * far_t).v, kD, weight[0]);
  hn::Store((s * far_t).v, kD, weight[1]);
  hn::Store((far_s * t).v, kD, weight[2]);
  hn::Store((s * t).v, kD, weight[3]);
  for (int l = 0; l < kLanes; ++l) {
    const float* tap[4];
    for (int k = 0; k < 4; ++k) tap[k] = texture.texels + 4 * std::ptrdiff_t{at[k][l]};
    for (int c = 0; c < 4; ++c) {
      texels[4 * l + c] = weight[0][l] * tap[0][c] + weight[1][l] * tap[1][c] +
                          weight[2][l] * tap[2][c] + weight[3][l] * tap[3][c];
    }
  }
  V r, g, b, alpha;
  hn::LoadInterleaved4(kD, texels, r, g, b, alpha);
  return {{Lane(r), Lane(g), Lane(b)}, Lane(alpha)};
}

/// For a plain material: repeats in both directions.
LIMPID_LANES_INLINE Rgb<Lane> sample(const PyramidView& texture, const Footprint& f) {
  return sample(texture, f, Wrap::kRepeat, Wrap::kRepeat).color;
}

/// The same as shadow_at(), for points relative to the eye.
LIMPID_LANES_INLINE Lane shadow_of(const ShadowView& map, Vec3<Lane> point, Vec3<Lane> normal,
                                   Lane cosine) {
  const auto row = [&](const float* r) {
    return Lane(r[0]) * point.x + Lane(r[1]) * point.y + Lane(r[2]) * point.z + Lane(r[3]);
  };
  const auto side = [&](const float* r) {
    return abs(Lane(r[0]) * normal.x + Lane(r[1]) * normal.y + Lane(r[2]) * normal.z);
  };
  const Mask faces = cosine > Lane(0);
  const Lane slope = (side(map.side[0]) + side(map.side[1])) / select(faces, cosine, Lane(1));
  const Lane bias = Lane(map.bias_texels) * min(slope, Lane(map.max_slope)) + Lane(map.bias);
  const Lane depth = row(map.map[2]) - bias;
  const Lane limit(1e6);
  const Lane x = min(max(row(map.map[0]) - Lane(0.5), Lane(0) - limit), limit);
  const Lane y = min(max(row(map.map[1]) - Lane(0.5), Lane(0) - limit), limit);
  const Lane whole_x = floor(x), whole_y = floor(y);
  const Lane s = x - whole_x, t = y - whole_y;
  const VI left = hn::Sub(hn::ConvertTo(kDI, whole_x.v), hn::Set(kDI, 1));
  const VI top = hn::Sub(hn::ConvertTo(kDI, whole_y.v), hn::Set(kDI, 1));
  const VI last = hn::Set(kDI, map.size - 1), zero = hn::Zero(kDI);
  const Lane across[4] = {Lane(1) - s, Lane(1), Lane(1), s};
  const Lane down[4] = {Lane(1) - t, Lane(1), Lane(1), t};
  Lane lit(0);
  for (int j = 0; j < 4; ++j) {
    const VI row_at = hn::Add(top, hn::Set(kDI, j));
    const VI y_at = hn::Min(hn::Max(row_at, zero), last);
    const auto y_out = hn::Ne(y_at, row_at);
    Lane row_lit(0);
    for (int i = 0; i < 4; ++i) {
      const VI column = hn::Add(left, hn::Set(kDI, i));
      const VI x_at = hn::Min(hn::Max(column, zero), last);
      const Mask out = {hn::RebindMask(kD, hn::Or(y_out, hn::Ne(x_at, column)))};
      const VI index = hn::Add(hn::Mul(y_at, hn::Set(kDI, map.y_stride)), x_at);
      const Lane stored(hn::GatherIndex(kD, map.depth, index));
      row_lit = row_lit + select(out || depth <= stored, across[i], Lane(0));
    }
    lit = lit + down[j] * row_lit;
  }
  return select(faces, Lane(1.0 / 9) * lit, Lane(0));
}

}  // namespace limpid::raster::HWY_NAMESPACE

#pragma once
#include "limpid/core/vec.h"

#include "raster/raster_job.h"
#include "raster/visibility.h"

/// Attributes of visible triangles at pixels: depth, normal, uv and its footprint, in lanes. For
/// inclusion by raster_target.cpp alone.

namespace limpid::raster::HWY_NAMESPACE {

/// The triangles of one vector of pixels, in lanes.
struct Corners {
  alignas(64) std::int32_t x[3][kLanes], y[3][kLanes];
  alignas(64) double a[kLanes], b[kLanes], c[kLanes];
  Lane q_min, q_max;
  VI material;
  Lane q[3];
  Vec3<Lane> normal[3];
  Lane u[3], v[3];
};

/// A place in a texture, and its derivatives from pixel to pixel.
struct Footprint {
  Lane u, v, u_dx, v_dx, u_dy, v_dy;
};

/// Pixels of one row, kLanes at a time.
struct Fragment {
  Mask covered;
  VI material;  ///< with Triangle::kBack
  Lane depth;
  Vec3<Lane> normal;  ///< interpolated, not unit
  Footprint uv;
};

/// Weights of a triangle's corners at a pixel, and their derivatives: a value's derivative is the
/// sum over the corners of dx times the corner's difference from the pixel's own value, which keeps
/// the precision of uvs far from 0.
struct Shares {
  Lane of[3], dx[3], dy[3];
};

LIMPID_LANES_INLINE const Triangle& triangle_of(const ShadeJob& job, std::int32_t id) {
  const std::uint32_t bits = static_cast<std::uint32_t>(id);
  return job.groups[bits >> 16].triangles[bits & 0xffff];
}

template <bool kLit>
LIMPID_LANES_INLINE void set_all(const ShadeJob& job, const Triangle& t, Corners& out) {
  for (int l = 0; l < kLanes; l += kWide) {
    hn::Store(hn::Set(kWD, t.a), kWD, out.a + l);
    hn::Store(hn::Set(kWD, t.b), kWD, out.b + l);
    hn::Store(hn::Set(kWD, t.c), kWD, out.c + l);
  }
  out.q_min = Lane(hn::Set(kD, t.q_min));
  out.q_max = Lane(hn::Set(kD, t.q_max));
  out.material = hn::Set(kDI, static_cast<std::int32_t>(t.material));
  for (int k = 0; k < 3; ++k) {
    const Corner& corner = job.corners[t.corner[k]];
    hn::Store(hn::Set(kDI, corner.x), kDI, out.x[k]);
    hn::Store(hn::Set(kDI, corner.y), kDI, out.y[k]);
    out.q[k] = Lane(hn::Set(kD, corner.q));
    if constexpr (!kLit) continue;
    const Attributes& more = job.attributes[t.corner[k]];
    out.normal[k] = {Lane(hn::Set(kD, corner.normal_x)), Lane(hn::Set(kD, more.normal_y)),
                     Lane(hn::Set(kD, more.normal_z))};
    out.u[k] = Lane(hn::Set(kD, more.u));
    out.v[k] = Lane(hn::Set(kD, more.v));
  }
}

/// Copies whole 16-byte records to a row, to be distributed to lanes later: cheaper than gathers.
template <bool kLit>
LIMPID_LANES_INLINE void set_each(const ShadeJob& job, const std::int32_t* ids, Corners& out) {
  alignas(64) float corner_rows[3][4 * kLanes], attribute_rows[3][4 * kLanes];
  alignas(64) float q_min[kLanes], q_max[kLanes];
  alignas(64) std::int32_t material[kLanes];
  for (int l = 0; l < kLanes; ++l) {
    const Triangle& t = triangle_of(job, ids[l]);
    out.a[l] = t.a;
    out.b[l] = t.b;
    out.c[l] = t.c;
    q_min[l] = t.q_min;
    q_max[l] = t.q_max;
    material[l] = static_cast<std::int32_t>(t.material);
    for (int k = 0; k < 3; ++k) {
      __builtin_memcpy(corner_rows[k] + 4 * l, job.corners + t.corner[k], 16);
      if constexpr (kLit) {
        __builtin_memcpy(attribute_rows[k] + 4 * l, job.attributes + t.corner[k], 16);
      }
    }
  }
  out.q_min = Lane(hn::Load(kD, q_min));
  out.q_max = Lane(hn::Load(kD, q_max));
  out.material = hn::Load(kDI, material);
  for (int k = 0; k < 3; ++k) {
    V x, y, q, nx;
    hn::LoadInterleaved4(kD, corner_rows[k], x, y, q, nx);
    hn::Store(hn::BitCast(kDI, x), kDI, out.x[k]);
    hn::Store(hn::BitCast(kDI, y), kDI, out.y[k]);
    out.q[k] = Lane(q);
    if constexpr (!kLit) continue;
    V ny, nz, u, v;
    hn::LoadInterleaved4(kD, attribute_rows[k], ny, nz, u, v);
    out.normal[k] = {Lane(nx), Lane(ny), Lane(nz)};
    out.u[k] = Lane(u);
    out.v[k] = Lane(v);
  }
}

struct Edges {
  Lane value[3], dx[3], dy[3];  ///< dx, dy per pixel
};

/// The three edge functions at the pixels' centres, from integers in double: exact, however thin
/// the triangle. `x`, `y`: the first pixel.
LIMPID_LANES_INLINE Edges edges_of(const Corners& in, int x, int y) {
  alignas(64) float value[3][kLanes], dx[3][kLanes], dy[3][kLanes];
  for (int l = 0; l < kLanes; l += kWide) {
    const VWD centre_x =
        hn::MulAdd(wide(hn::Iota(kWI, x + l)), wide(kSubpixels), wide(kSubpixels / 2));
    const VWD centre_y = wide(double{kSubpixels} * y + kSubpixels / 2);
    VWD at_x[3], at_y[3];
    for (int k = 0; k < 3; ++k) {
      at_x[k] = wide(hn::Load(kWI, in.x[k] + l));
      at_y[k] = wide(hn::Load(kWI, in.y[k] + l));
    }
    for (int k = 0; k < 3; ++k) {
      const int from = k == 2 ? 0 : k + 1, to = k == 0 ? 2 : k - 1;
      const VWD along_x = hn::Sub(at_x[to], at_x[from]), along_y = hn::Sub(at_y[to], at_y[from]);
      const VWD e = hn::Sub(hn::Mul(along_x, hn::Sub(centre_y, at_y[from])),
                            hn::Mul(along_y, hn::Sub(centre_x, at_x[from])));
      hn::Store(hn::DemoteTo(kWF, e), kWF, value[k] + l);
      hn::Store(hn::DemoteTo(kWF, hn::Mul(along_y, wide(-kSubpixels))), kWF, dx[k] + l);
      hn::Store(hn::DemoteTo(kWF, hn::Mul(along_x, wide(kSubpixels))), kWF, dy[k] + l);
    }
  }
  Edges edges;
  for (int k = 0; k < 3; ++k) {
    edges.value[k] = Lane(hn::Load(kD, value[k]));
    edges.dx[k] = Lane(hn::Load(kD, dx[k]));
    edges.dy[k] = Lane(hn::Load(kD, dy[k]));
  }
  return edges;
}

LIMPID_LANES_INLINE Lane depth_of(const ShadeJob& job, const Corners& in, int x, int y) {
  alignas(64) float q[kLanes];
  const VWD centre_y = wide(y + 0.5);
  for (int l = 0; l < kLanes; l += kWide) {
    const VWD centre_x = hn::Add(wide(hn::Iota(kWI, x + l)), wide(0.5));
    const VWD value =
        hn::MulAdd(hn::Load(kWD, in.a + l), centre_x,
                   hn::MulAdd(hn::Load(kWD, in.b + l), centre_y, hn::Load(kWD, in.c + l)));
    hn::Store(hn::DemoteTo(kWF, value), kWF, q + l);
  }
  const Lane kept = min(max(Lane(hn::Load(kD, q)), in.q_min), in.q_max);
  return job.perspective ? Lane(1) / kept : Lane(0) - kept;
}

LIMPID_LANES_INLINE Shares shares_of(const ShadeJob& job, const Corners& in, int x, int y,
                                     Mask covered) {
  // attribute = sum(e_k p_k attribute_k) / sum(e_k p_k), p = 1 / Z: perspective-correct.
  const Edges edges = edges_of(in, x, y);
  Lane p[3], weight[3], sum(0);
  for (int k = 0; k < 3; ++k) {
    p[k] = job.perspective ? in.q[k] : Lane(1);
    weight[k] = edges.value[k] * p[k];
    sum = sum + weight[k];
  }
  const Mask inside = covered && sum > Lane(0);
  const Lane inverse = select(inside, Lane(1) / select(inside, sum, Lane(1)), Lane(0));
  Shares shares;
  for (int k = 0; k < 3; ++k) {
    shares.of[k] = weight[k] * inverse;
    shares.dx[k] = edges.dx[k] * p[k] * inverse;
    shares.dy[k] = edges.dy[k] * p[k] * inverse;
  }
  return shares;
}

template <class T>
LIMPID_LANES_INLINE T mixed(const Shares& shares, const T (&values)[3]) {
  return shares.of[0] * values[0] + shares.of[1] * values[1] + shares.of[2] * values[2];
}

LIMPID_LANES_INLINE Footprint footprint(const Shares& shares, const Lane (&u)[3],
                                        const Lane (&v)[3]) {
  Footprint at;
  at.u = mixed(shares, u);
  at.v = mixed(shares, v);
  at.u_dx = at.v_dx = at.u_dy = at.v_dy = Lane(0);
  for (int k = 0; k < 3; ++k) {
    const Lane du = u[k] - at.u, dv = v[k] - at.v;
    at.u_dx = at.u_dx + shares.dx[k] * du;
    at.v_dx = at.v_dx + shares.dx[k] * dv;
    at.u_dy = at.u_dy + shares.dy[k] * du;
    at.v_dy = at.v_dy + shares.dy[k] * dv;
  }
  return at;
}

/// Interpolates normal and uv.
LIMPID_LANES_INLINE void interpolate(const Shares& shares, const Corners& in, Fragment& f) {
  f.normal = mixed(shares, in.normal);
  f.uv = footprint(shares, in.u, in.v);
}

/// `ids`: those of the pixels (x ... x + kLanes - 1, y), of which at least one is covered. Loads
/// their triangles into `in`, and returns the covered lanes.
template <bool kLit>
LIMPID_LANES_INLINE Mask find_corners(const ShadeJob& job, const std::int32_t* ids, Corners& in) {
  const VI id = hn::Load(kDI, ids), nothing = hn::Set(kDI, static_cast<std::int32_t>(kNothing));
  const auto covered = hn::Ne(id, nothing);
  int first = 0;
  while (ids[first] == static_cast<std::int32_t>(kNothing)) ++first;
  const VI all = hn::Set(kDI, ids[first]);
  if (hn::AllTrue(kDI, hn::Or(hn::Not(covered), hn::Eq(id, all)))) {
    set_all<kLit>(job, triangle_of(job, ids[first]), in);
  } else {
    alignas(64) std::int32_t some[kLanes];
    hn::Store(hn::IfThenElse(covered, id, all), kDI, some);
    set_each<kLit>(job, some, in);
  }
  return {hn::RebindMask(kD, covered)};
}

/// Without kLit only coverage and depth.
template <bool kLit>
LIMPID_LANES_INLINE void find_fragment(const ShadeJob& job, const std::int32_t* ids, int x, int y,
                                       Fragment& f) {
  Corners in;
  f.covered = find_corners<kLit>(job, ids, in);
  f.material = in.material;
  f.depth = depth_of(job, in, x, y);
  if constexpr (kLit) interpolate(shares_of(job, in, x, y, f.covered), in, f);
}

}  // namespace limpid::raster::HWY_NAMESPACE

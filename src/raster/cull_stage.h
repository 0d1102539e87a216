#pragma once
#include "raster/raster_job.h"
#include "raster/wide.h"

/// Culls invisible triangles and sets up the planes of the others. For inclusion by
/// raster_target.cpp alone.

namespace limpid::raster::HWY_NAMESPACE {

using namespace limpid::HWY_NAMESPACE;
using MWI = hn::Mask<WI>;

LIMPID_LANES_INLINE VWI ints(int x) { return hn::Set(kWI, x); }

/// `left` lanes of kWide triangles count; `indices` has room for three vectors.
LIMPID_LANES_INLINE void cull_wide(const DrawnInstance& instance, const Screen& screen,
                                   const Corner* corners, const std::uint32_t* indices, int first,
                                   int left, Survivors& out) {
  VWI i[3], x[3], y[3];
  hn::LoadInterleaved3(kWI, reinterpret_cast<const std::int32_t*>(indices), i[0], i[1], i[2]);
  const auto* words = reinterpret_cast<const std::int32_t*>(corners);
  for (int k = 0; k < 3; ++k) {
    i[k] = hn::Add(i[k], ints(static_cast<int>(instance.first_vertex)));
    const VWI at = hn::ShiftLeft<2>(i[k]);
    x[k] = hn::GatherIndex(kWI, words, at);
    y[k] = hn::GatherIndex(kWI, words + 1, at);
  }
  const MWI real = hn::Lt(hn::Iota(kWI, 0), ints(left));
  const VWI limit = ints(-kGuard - 1);
  const MWI c0 = hn::Lt(x[0], limit), c1 = hn::Lt(x[1], limit), c2 = hn::Lt(x[2], limit);
  const MWI clipped = hn::And(real, hn::Or(c0, hn::Or(c1, c2)));
  if (!hn::AllFalse(kWI, clipped)) {
    // Culled if all three corners are beyond one plane. Corners inside have no bits.
    const auto bits = [&](MWI c, VWI value) {
      return hn::IfThenElseZero(c, hn::Sub(value, ints(kClipped)));
    };
    const VWI common = hn::And(bits(c0, x[0]), hn::And(bits(c1, x[1]), bits(c2, x[2])));
    const MWI to_clip = hn::And(clipped, hn::Eq(common, hn::Zero(kWI)));
    hn::StoreU(hn::Compress(hn::Iota(kWI, first), to_clip), kWI, out.to_clip + out.clip_count);
    out.clip_count += static_cast<int>(hn::CountTrue(kWI, to_clip));
  }

  // Twice the area, exactly: the terms have at most 48 bits.
  const VWD dx1 = wide(hn::Sub(x[1], x[0])), dy1 = wide(hn::Sub(y[1], y[0]));
  const VWD dx2 = wide(hn::Sub(x[2], x[0])), dy2 = wide(hn::Sub(y[2], y[0]));
  const VWD cross = hn::Sub(hn::Mul(dx1, dy2), hn::Mul(dx2, dy1));
  const VWD zero = hn::Zero(kWD);
  const auto as_int_mask = [](MWD m) {  // DemoteTo of -1 and 0 works on every target
    return hn::Lt(hn::DemoteTo(kWI, hn::IfThenElseZero(m, wide(-1.0))), hn::Zero(kWI));
  };
  const MWI clockwise = as_int_mask(hn::Gt(cross, zero)), turned = as_int_mask(hn::Lt(cross, zero));
  const MWI front = instance.flip ? clockwise : turned;
  const MWI shown = hn::And(real, instance.cull ? front : hn::Or(clockwise, turned));

  // Pixels whose centres are in the bounding box.
  const VWI low_x = hn::Min(x[0], hn::Min(x[1], x[2])), low_y = hn::Min(y[0], hn::Min(y[1], y[2]));
  const VWI high_x = hn::Max(x[0], hn::Max(x[1], x[2])),
            high_y = hn::Max(y[0], hn::Max(y[1], y[2]));
  const VWI up = ints(kSubpixels / 2 - 1), down = ints(kSubpixels / 2);
  const VWI x0 = hn::Max(hn::ShiftRight<8>(hn::Add(low_x, up)), ints(screen.x0));
  const VWI y0 = hn::Max(hn::ShiftRight<8>(hn::Add(low_y, up)), ints(screen.y0));
  const VWI x1 = hn::Min(hn::ShiftRight<8>(hn::Sub(high_x, down)), ints(screen.x1 - 1));
  const VWI y1 = hn::Min(hn::ShiftRight<8>(hn::Sub(high_y, down)), ints(screen.y1 - 1));
  const MWI covers = hn::Not(hn::Or(hn::Lt(x1, x0), hn::Lt(y1, y0)));
  const MWI keep = hn::AndNot(clipped, hn::And(shown, covers));
  if (hn::AllFalse(kWI, keep)) return;

  const auto put = [&](std::int32_t* to, VWI value) {
    hn::StoreU(hn::Compress(value, keep), kWI, to + out.count);
  };
  put(out.corner[0], i[0]);
  put(out.corner[1], hn::IfThenElse(clockwise, i[1], i[2]));
  put(out.corner[2], hn::IfThenElse(clockwise, i[2], i[1]));
  put(out.back, hn::IfThenElseZero(hn::Not(front), ints(1)));
  put(out.x0, x0);
  put(out.y0, y0);
  put(out.x1, x1);
  put(out.y1, y1);
  out.count += static_cast<int>(hn::CountTrue(kWI, keep));
}

void cull(const DrawnInstance& instance, const Screen& screen, const Corner* corners, int first,
          int count, Survivors& out) {
  const std::uint32_t* indices = instance.mesh.indices;
  int i = first;
  for (; i + kWide <= first + count; i += kWide) {
    cull_wide(instance, screen, corners, indices + 3 * std::ptrdiff_t{i}, i, kWide, out);
  }
  const int left = first + count - i;
  if (left <= 0) return;
  std::uint32_t last[3 * kWide] = {};
  for (int k = 0; k < 3 * left; ++k) last[k] = indices[3 * std::ptrdiff_t{i} + k];
  cull_wide(instance, screen, corners, last, i, left, out);
}

struct WidePoint {
  VWD x, y, z;
};

LIMPID_LANES_INLINE VWD dot_point(const double* row, const WidePoint& p) {
  return dot_wide(row, p.x, p.y, p.z);
}

/// Sets up planes of kWide triangles from survivor `k` on; the first `left` count.
LIMPID_LANES_INLINE void set_up_wide(const DrawnInstance& instance, const Corner* corners,
                                     const Survivors& s, int k, int left, Triangle* triangles) {
  alignas(64) float position[9][kWide];
  alignas(64) float q_min[kWide], q_max[kWide];
  for (int l = 0; l < kWide; ++l) {
    const int from = k + (l < left ? l : 0);
    float least = 0, most = 0;
    for (int v = 0; v < 3; ++v) {
      const std::uint32_t corner = static_cast<std::uint32_t>(s.corner[v][from]);
      const float* p = instance.mesh.positions + 3 * std::ptrdiff_t{corner - instance.first_vertex};
      position[3 * v][l] = p[0];
      position[3 * v + 1][l] = p[1];
      position[3 * v + 2][l] = p[2];
      const float q = corners[corner].q;
      least = v == 0 || q < least ? q : least;
      most = v == 0 || q > most ? q : most;
    }
    q_min[l] = least;
    q_max[l] = most;
  }
  const auto load = [&](int n) { return wide(hn::Load(kWF, position[n])); };
  const WidePoint p0{load(0), load(1), load(2)};
  const VWD ax = hn::Sub(load(3), p0.x), ay = hn::Sub(load(4), p0.y), az = hn::Sub(load(5), p0.z);
  const VWD bx = hn::Sub(load(6), p0.x), by = hn::Sub(load(7), p0.y), bz = hn::Sub(load(8), p0.z);
  // Products are rounded before the subtraction: exactly 0 for collinear corners.
  const auto cross = [](VWD a, VWD b, VWD c, VWD d) {
    return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
  };
  const WidePoint n{cross(ay, bz, az, by), cross(az, bx, ax, bz), cross(ax, by, ay, bx)};
  const PlaneRays& r = instance.rays;
  const WidePoint place{hn::MulAdd(wide(r.determinant), p0.x, wide(r.offset[0])),
                        hn::MulAdd(wide(r.determinant), p0.y, wide(r.offset[1])),
                        hn::MulAdd(wide(r.determinant), p0.z, wide(r.offset[2]))};
  const VWD d = hn::MulAdd(n.x, place.x, hn::MulAdd(n.y, place.y, hn::Mul(n.z, place.z)));
  const VWD divisor = r.perspective ? d : dot_point(r.axis, n);
  const VWD along = r.perspective ? dot_point(r.ray, n) : hn::Sub(dot_point(r.ray, n), d);
  const VWD inverse = hn::Div(wide(1.0), divisor);
  const VWD a = hn::Mul(dot_point(r.ray_dx, n), inverse);
  const VWD b = hn::Mul(dot_point(r.ray_dy, n), inverse);
  const VWD c = hn::Mul(along, inverse);
  // A plane through the eye has no slope on the screen: such a triangle has the depth of its
  // nearest corner. Collinear corners make no triangle.
  const VWD steepness = hn::Add(hn::Abs(a), hn::Add(hn::Abs(b), hn::Abs(c)));
  const MWD has_slope = hn::Lt(steepness, wide(1e30));
  const VWD least = wide(hn::Load(kWF, q_min)), most = wide(hn::Load(kWF, q_max));
  const VWD slope = hn::IfThenElseZero(has_slope, hn::Add(hn::Abs(a), hn::Abs(b)));
  // Snapped corners extend a triangle, and its q, by up to 1/512 pixel.
  const VWD slack = hn::Mul(wide(0.01), hn::Min(slope, hn::Sub(most, least)));
  const VWD lowest = hn::Sub(least, slack);
  const VWD floor = r.perspective ? hn::Max(lowest, hn::Mul(wide(0.5), least)) : lowest;
  const VWD size = hn::Add(hn::Abs(n.x), hn::Add(hn::Abs(n.y), hn::Abs(n.z)));

  alignas(64) double out_a[kWide], out_b[kWide], out_c[kWide], out_size[kWide];
  hn::Store(hn::IfThenElseZero(has_slope, a), kWD, out_a);
  hn::Store(hn::IfThenElseZero(has_slope, b), kWD, out_b);
  hn::Store(hn::IfThenElse(has_slope, c, most), kWD, out_c);
  hn::Store(size, kWD, out_size);
  hn::Store(hn::DemoteTo(kWF, floor), kWF, q_min);
  hn::Store(hn::DemoteTo(kWF, hn::Add(most, slack)), kWF, q_max);
  for (int l = 0; l < left; ++l) {
    Triangle& t = triangles[k + l];
    for (int v = 0; v < 3; ++v) t.corner[v] = static_cast<std::uint32_t>(s.corner[v][k + l]);
    t.material = instance.material | (s.back[k + l] ? Triangle::kBack : 0);
    t.a = out_a[l];
    t.b = out_b[l];
    t.c = out_c[l];
    t.q_min = q_min[l];
    t.q_max = q_max[l];
    if (!(out_size[l] > 0)) s.x1[k + l] = s.x0[k + l] - 1;  // covers no pixel
  }
}

void set_up(const DrawnInstance& instance, const Corner* corners, const Survivors& survivors,
            Triangle* triangles) {
  for (int k = 0; k < survivors.count; k += kWide) {
    const int left = survivors.count - k < kWide ? survivors.count - k : kWide;
    set_up_wide(instance, corners, survivors, k, left, triangles);
  }
}

}  // namespace limpid::raster::HWY_NAMESPACE

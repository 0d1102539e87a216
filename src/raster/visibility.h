#pragma once
#include "raster/raster_job.h"
#include "raster/wide.h"

/// The visible triangle of each pixel of a tile. For inclusion by raster_target.cpp alone.

namespace limpid::raster::HWY_NAMESPACE {

using namespace limpid::HWY_NAMESPACE;

/// Rows of a tile, with room for a vector that starts at the last pixel.
constexpr int kTileStride = kTile + 16;

struct alignas(64) Visibility {
  float q[kTile * kTileStride];
  std::int32_t id[kTile * kTileStride];  ///< group << 16 | triangle, or kNothing
};

/// Edge functions and depth of kWide triangles at the first pixel of each triangle's box in the
/// tile. edge + i edge_dx + j edge_dy >= 0, for all three, is inside at pixel (i, j) of the box: it
/// includes the top-left rule and the scale of 1/256 pixel, exactly.
struct alignas(64) EdgeBatch {
  std::int32_t edge[3][kWide], edge_dx[3][kWide], edge_dy[3][kWide];
  std::int32_t x0[kWide], y0[kWide], x1[kWide], y1[kWide];
  float q[kWide], q_dx[kWide], q_dy[kWide], q_min[kWide], q_max[kWide];
};

LIMPID_LANES_INLINE void fill(Visibility& v) {
  for (int i = 0; i < kTile * kTileStride; i += kLanes) {
    hn::Store(hn::Set(kD, -3e38f), kD, v.q + i);
    hn::Store(hn::Set(kDI, static_cast<std::int32_t>(kNothing)), kDI, v.id + i);
  }
}

/// `tile`: its pixels, from Screen::origin. Lanes from `count` on repeat the first.
LIMPID_LANES_INLINE void make_batch(const GroupView& group, const std::uint32_t* entries, int count,
                                    const Corner* corners, const Screen& tile, EdgeBatch& batch) {
  alignas(64) std::int32_t in_x[3][kWide], in_y[3][kWide];
  alignas(64) double a[kWide], b[kWide], c[kWide];
  for (int l = 0; l < kWide; ++l) {
    const Triangle& t = group.triangles[entries[l < count ? l : 0]];
    for (int k = 0; k < 3; ++k) {
      const Corner& corner = corners[t.corner[k]];
      in_x[k][l] = corner.x;
      in_y[k][l] = corner.y;
    }
    a[l] = t.a;
    b[l] = t.b;
    c[l] = t.c;
    batch.q_min[l] = t.q_min;
    batch.q_max[l] = t.q_max;
  }
  VWI x[3], y[3];
  for (int k = 0; k < 3; ++k) {
    x[k] = hn::Load(kWI, in_x[k]);
    y[k] = hn::Load(kWI, in_y[k]);
  }
  const auto least = [](const VWI* v) { return hn::Min(v[0], hn::Min(v[1], v[2])); };
  const auto most = [](const VWI* v) { return hn::Max(v[0], hn::Max(v[1], v[2])); };
  const auto first = [](VWI low, int begin) {
    const VWI up = hn::Add(low, hn::Set(kWI, kSubpixels / 2 - 1));
    return hn::Max(hn::ShiftRight<8>(up), hn::Set(kWI, begin));
  };
  const auto last = [](VWI high, int end) {
    const VWI down = hn::Sub(high, hn::Set(kWI, kSubpixels / 2));
    return hn::Min(hn::ShiftRight<8>(down), hn::Set(kWI, end - 1));
  };
  const VWI x0 = first(least(x), tile.x0), y0 = first(least(y), tile.y0);
  const VWI x1 = last(most(x), tile.x1), y1 = last(most(y), tile.y1);
  const VWD pixel_x = wide(x0), pixel_y = wide(y0);
  const VWD centre_x = hn::MulAdd(pixel_x, wide(kSubpixels), wide(kSubpixels / 2));
  const VWD centre_y = hn::MulAdd(pixel_y, wide(kSubpixels), wide(kSubpixels / 2));
  for (int k = 0; k < 3; ++k) {
    const int from = k == 2 ? 0 : k + 1, to = k == 0 ? 2 : k - 1;
    const VWI dx = hn::Sub(x[to], x[from]), dy = hn::Sub(y[to], y[from]);
    const VWD wide_dx = wide(dx), wide_dy = wide(dy);
    const VWD value = hn::Sub(hn::Mul(wide_dx, hn::Sub(centre_y, wide(y[from]))),
                              hn::Mul(wide_dy, hn::Sub(centre_x, wide(x[from]))));
    // Top and left edges own their pixels: 0 is inside there.
    const VWD zero = hn::Zero(kWD);
    const MWD owns =
        hn::Or(hn::Lt(wide_dy, zero), hn::And(hn::Eq(wide_dy, zero), hn::Gt(wide_dx, zero)));
    const VWD biased = hn::Sub(value, hn::IfThenElse(owns, zero, wide(1.0)));
    const VWD steps = hn::Floor(hn::Mul(biased, wide(1.0 / kSubpixels)));
    // Beyond 2^30 the whole tile is on one side.
    const VWD far = wide(1 << 30);
    const VWD kept = hn::Min(hn::Max(steps, hn::Neg(far)), far);
    hn::Store(hn::DemoteTo(kWI, kept), kWI, batch.edge[k]);
    hn::Store(hn::Neg(dy), kWI, batch.edge_dx[k]);
    hn::Store(dx, kWI, batch.edge_dy[k]);
  }
  const VWD wa = hn::Load(kWD, a), wb = hn::Load(kWD, b), half = wide(0.5);
  const VWD q = hn::MulAdd(wa, hn::Add(pixel_x, half),
                           hn::MulAdd(wb, hn::Add(pixel_y, half), hn::Load(kWD, c)));
  hn::Store(hn::DemoteTo(kWF, q), kWF, batch.q);
  hn::Store(hn::DemoteTo(kWF, wa), kWF, batch.q_dx);
  hn::Store(hn::DemoteTo(kWF, wb), kWF, batch.q_dy);
  hn::Store(hn::Sub(x0, hn::Set(kWI, tile.x0)), kWI, batch.x0);
  hn::Store(hn::Sub(y0, hn::Set(kWI, tile.y0)), kWI, batch.y0);
  hn::Store(hn::Sub(x1, hn::Set(kWI, tile.x0)), kWI, batch.x1);
  hn::Store(hn::Sub(y1, hn::Set(kWI, tile.y0)), kWI, batch.y1);
}

/// Accepts every fragment of a triangle.
struct EveryFragment {
  LIMPID_LANES_INLINE M operator()(V, int, int, M put) const { return put; }
};

/// Draws one triangle of the batch into the tile. The nearest wins, among equals the first.
/// `test(q, x, y, put)` returns which of the fragments `put`, from pixel (x, y) of the tile on,
/// exist.
template <class Test>
LIMPID_LANES_INLINE void draw(const EdgeBatch& batch, int l, std::int32_t id, Visibility& out,
                              Test&& test) {
  const int x0 = batch.x0[l], x1 = batch.x1[l], y1 = batch.y1[l];
  const VI lane = hn::Iota(kDI, 0);
  VI edge[3], across[3], down[3];
  for (int k = 0; k < 3; ++k) {
    across[k] = hn::Set(kDI, batch.edge_dx[k][l]);
    down[k] = hn::Set(kDI, batch.edge_dy[k][l]);
    edge[k] = hn::Add(hn::Set(kDI, batch.edge[k][l]), hn::Mul(across[k], lane));
  }
  const V q_dx = hn::Set(kD, batch.q_dx[l]), q_dy = hn::Set(kD, batch.q_dy[l]);
  const V q_min = hn::Set(kD, batch.q_min[l]), q_max = hn::Set(kD, batch.q_max[l]);
  V q = hn::MulAdd(q_dx, hn::ConvertTo(kD, lane), hn::Set(kD, batch.q[l]));
  const VI new_id = hn::Set(kDI, id);
  const auto visit = [&](VI e, V depth, int x, int y) {
    const int at = y * kTileStride + x;
    const V kept = hn::Min(hn::Max(depth, q_min), q_max);
    const V old = hn::LoadU(kD, out.q + at);
    const M nearer = hn::Gt(kept, old);
    const M inside = hn::RebindMask(kD, hn::Gt(e, hn::Set(kDI, -1)));
    const M put = test(kept, x, y, hn::And(inside, nearer));
    hn::BlendedStore(kept, put, kD, out.q + at);
    hn::BlendedStore(new_id, hn::RebindMask(kDI, put), kDI, out.id + at);
  };
  if (x1 - x0 < kLanes) {
    for (int y = batch.y0[l]; y <= y1; ++y) {
      visit(hn::Or(edge[0], hn::Or(edge[1], edge[2])), q, x0, y);
      for (int k = 0; k < 3; ++k) edge[k] = hn::Add(edge[k], down[k]);
      q = hn::Add(q, q_dy);
    }
    return;
  }
  const VI lanes = hn::Set(kDI, kLanes);
  const V q_step = hn::Mul(q_dx, hn::Set(kD, static_cast<float>(kLanes)));
  VI step[3];
  for (int k = 0; k < 3; ++k) step[k] = hn::Mul(across[k], lanes);
  for (int y = batch.y0[l]; y <= y1; ++y) {
    VI e[3] = {edge[0], edge[1], edge[2]};
    V depth = q;
    for (int x = x0; x <= x1; x += kLanes) {
      visit(hn::Or(e[0], hn::Or(e[1], e[2])), depth, x, y);
      for (int k = 0; k < 3; ++k) e[k] = hn::Add(e[k], step[k]);
      depth = hn::Add(depth, q_step);
    }
    for (int k = 0; k < 3; ++k) edge[k] = hn::Add(edge[k], down[k]);
    q = hn::Add(q, q_dy);
  }
}

/// A tile of the window.
struct Tile {
  int tx, ty;
  Screen pixels;
};

/// The index of the tile in the group's offsets, or -1.
LIMPID_LANES_INLINE int place_of(const GroupView& group, const Tile& tile) {
  const int tx = tile.tx, ty = tile.ty;
  if (tx < group.tx0 || tx >= group.tx1 || ty < group.ty0 || ty >= group.ty1) return -1;
  return (ty - group.ty0) * (group.tx1 - group.tx0) + tx - group.tx0;
}

/// Calls draw_one(batch, lane, id) for every triangle of these groups in the tile.
template <class DrawOne>
LIMPID_LANES_INLINE void each_triangle(const ShadeJob& job, const Tile& tile, int first_group,
                                       int end_group, DrawOne&& draw_one) {
  EdgeBatch batch;
  for (int g = first_group; g < end_group; ++g) {
    const GroupView& group = job.groups[g];
    const int t = place_of(group, tile);
    if (t < 0) continue;
    const std::uint32_t end = group.offsets[t + 1];
    for (std::uint32_t e = group.offsets[t]; e < end; e += kWide) {
      const int count =
          end - e < static_cast<std::uint32_t>(kWide) ? static_cast<int>(end - e) : kWide;
      make_batch(group, group.entries + e, count, job.corners, tile.pixels, batch);
      for (int l = 0; l < count; ++l) {
        draw_one(batch, l,
                 static_cast<std::int32_t>((static_cast<std::uint32_t>(g) << 16) |
                                           group.entries[e + static_cast<std::uint32_t>(l)]));
      }
    }
  }
}

/// Opaque materials only.
LIMPID_LANES_INLINE void find_visible(const ShadeJob& job, const Tile& tile, Visibility& out) {
  fill(out);
  each_triangle(job, tile, 0, job.opaque_groups,
                [&](const EdgeBatch& batch, int l, std::int32_t id)
                    LIMPID_LANES_LAMBDA { draw(batch, l, id, out, EveryFragment{}); });
}

}  // namespace limpid::raster::HWY_NAMESPACE

// Compiled once for each instruction set, as run/lanes_target.cpp is; the same holds here.
#include "core/lanes.h"
#include "plan/survey_scan.h"

namespace limpid::HWY_NAMESPACE {
namespace {

/// `count` texels of a row; lanes beyond hold the last one again.
LIMPID_LANES_INLINE Lane load(const float* from, std::ptrdiff_t x_stride, int count) {
  if (x_stride == 1 && count >= kLanes) return Lane(hn::LoadU(kD, from));
  alignas(64) float buffer[kLanes];
  for (int i = 0; i < kLanes; ++i) buffer[i] = from[(i < count ? i : count - 1) * x_stride];
  return Lane(hn::Load(kD, buffer));
}

/// Where a row of a view begins, at column x0.
LIMPID_LANES_INLINE const float* row_of(const View<const float>& view, int x0, int y) {
  return view.data + std::ptrdiff_t{y - view.window.y0} * view.y_stride +
         std::ptrdiff_t{x0 - view.window.x0} * view.x_stride;
}

LIMPID_LANES_INLINE float least(Lane v) {
  alignas(64) float lanes[kLanes];
  hn::Store(v.v, kD, lanes);
  float result = lanes[0];
  for (int i = 1; i < kLanes; ++i) result = lanes[i] < result ? lanes[i] : result;
  return result;
}
LIMPID_LANES_INLINE float greatest(Lane v) { return -least(Lane(0) - v); }

LIMPID_LANES_INLINE float sum(Lane v) {
  alignas(64) float lanes[kLanes];
  hn::Store(v.v, kD, lanes);
  float result = 0;
  for (int i = 0; i < kLanes; ++i) result += lanes[i];
  return result;
}

/// Asks for the 32 floats from here on. Rows of a chunk lie pages apart, where the machine does not
/// look ahead by itself: each asks for the next.
LIMPID_LANES_INLINE void prefetch(const float* from) {
  __builtin_prefetch(from);
  __builtin_prefetch(from + 16);
}

/// Calls visit(block, x0, x1) for the blocks that `pixels` meet, with the columns of each.
template <class Visit>
LIMPID_LANES_INLINE void for_each_block(const Rect& pixels, Blocks blocks, Visit&& visit) {
  int block = (pixels.x0 - blocks.x0) / blocks.width;
  for (int x0 = pixels.x0; x0 < pixels.x1; ++block) {
    const int end = blocks.x0 + (block + 1) * blocks.width;
    const int x1 = end < pixels.x1 ? end : pixels.x1;
    visit(block, x0, x1);
    x0 = x1;
  }
}

struct RangeLanes {
  Lane low{HUGE_VAL}, high{-HUGE_VAL};
};

void range(const View<const float>& view, const Rect& pixels, Blocks blocks, LowHigh* out) {
  RangeLanes lanes[Blocks::kMost];
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    const float* row = row_of(view, 0, y);
    for_each_block(pixels, blocks, [&](int block, int x0, int x1) {
      RangeLanes r = lanes[block];
      if (y + 1 < pixels.y1) prefetch(row + x0 * view.x_stride + view.y_stride);
      for (int x = x0; x < x1; x += kLanes) {
        const Lane value = load(row + x * view.x_stride, view.x_stride, x1 - x);
        r.low = min(r.low, value);
        r.high = max(r.high, value);
      }
      lanes[block] = r;
    });
  }
  for_each_block(pixels, blocks, [&](int block, int, int) {
    out[block] = {least(lanes[block].low), greatest(lanes[block].high)};
  });
}

/// Between which depths the surface lies.
struct Surface {
  Lane near, far;
};

/// Of the calm plane: |over| / under with `under` counted towards it, both off by their error.
LIMPID_LANES_INLINE Surface calm(const RowRays<Lane>& rays, const CalmError& error, Lane x) {
  const Lane infinite(HUGE_VAL);
  const Lane over = rays.calm_over + x * rays.calm_over_dx;
  const Lane along = rays.calm_under + x * rays.calm_under_dx;
  const Lane height = abs(over), off(error.over);
  const Lane under = select(over < Lane(0), Lane(0) - along, along);
  const Lane most = under + Lane(error.under), surely = under - Lane(error.under);
  // An eye in the plane itself, by all that is known, may see water anywhere.
  const Mask beside = height <= off;
  const Mask meets = most > Lane(0), sure = surely > Lane(0) && !beside;
  const Lane near = select(meets, (height - off) / select(meets, most, Lane(1)), infinite);
  const Lane far = select(sure, (height + off) / select(sure, surely, Lane(1)), infinite);
  return {select(beside, Lane(0), near), far};
}

struct WetLanes {
  Lane wet{0}, sure{0}, surface_near{HUGE_VAL}, surface_far{0}, own_near{HUGE_VAL}, own_far{0};

  LIMPID_LANES_INLINE void add(Lane dry, Surface water, Mask inside) {
    const Lane infinite(HUGE_VAL), zero(0), one(1);
    const Mask may = inside && water.near < dry, must = inside && water.far < dry;
    wet = wet + select(may, one, zero);
    sure = sure + select(must, one, zero);
    surface_near = min(surface_near, select(may, water.near, infinite));
    surface_far = max(surface_far, select(may, water.far, zero));
    own_near = min(own_near, select(may, select(must, dry - water.far, zero), infinite));
    own_far = max(own_far, select(may, dry - water.near, zero));
  }
};

/// With water_at(x, count): the surface of `count` pixels from the column x on.
template <class WaterAt>
LIMPID_LANES_INLINE void add_row(const View<const float>& depth, int y, const Rect& pixels,
                                 Blocks blocks, WetLanes* lanes, WaterAt&& water_at) {
  const float* depths = row_of(depth, 0, y);
  for_each_block(pixels, blocks, [&](int block, int x0, int x1) {
    WetLanes w = lanes[block];
    if (y + 1 < pixels.y1) prefetch(depths + x0 * depth.x_stride + depth.y_stride);
    for (int x = x0; x < x1; x += kLanes) {
      const int count = x1 - x;
      const Mask inside = Lane(hn::Iota(kD, 0.0f)) < Lane(count);
      w.add(load(depths + x * depth.x_stride, depth.x_stride, count), water_at(x, count), inside);
    }
    lanes[block] = w;
  });
}

void wet(const Context& context, const CalmError& error, const View<const float>& depth,
         const View<const float>& surface, const Rect& pixels, Blocks blocks, WetSeen* out) {
  WetLanes lanes[Blocks::kMost];
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    if (surface.data) {
      const float* surfaces = row_of(surface, 0, y);
      add_row(depth, y, pixels, blocks, lanes, [&](int x, int count) {
        if (y + 1 < pixels.y1) prefetch(surfaces + x * surface.x_stride + surface.y_stride);
        const Lane water = load(surfaces + x * surface.x_stride, surface.x_stride, count);
        return Surface{water, water};
      });
    } else {
      const RowRays<Lane> rays(context, y - context.corner.y + 0.5);
      add_row(depth, y, pixels, blocks, lanes, [&](int x, int) {
        const Lane column(hn::ConvertTo(kD, hn::Iota(kDI, x)));
        return calm(rays, error, column + Lane(0.5 - context.corner.x));
      });
    }
  }
  for_each_block(pixels, blocks, [&](int block, int, int) {
    const WetLanes& w = lanes[block];
    out[block] = {static_cast<int>(sum(w.wet)),
                  static_cast<int>(sum(w.sure)),
                  least(w.surface_near),
                  greatest(w.surface_far),
                  least(w.own_near),
                  greatest(w.own_far)};
  });
}

}  // namespace
}  // namespace limpid::HWY_NAMESPACE

namespace limpid {

#define LIMPID_JOIN_(a, b) a##b
#define LIMPID_JOIN(a, b) LIMPID_JOIN_(a, b)

extern const ScanTarget LIMPID_JOIN(kScan_, LIMPID_LANES_TARGET);
const ScanTarget LIMPID_JOIN(kScan_, LIMPID_LANES_TARGET) = {HWY_NAMESPACE::range,
                                                             HWY_NAMESPACE::wet};

}  // namespace limpid

// Compiled once for each instruction set, under the same rules as run/lanes_target.cpp.
#include "core/lanes.h"
#include "core/target_name.h"
#include "plan/survey_scan.h"

namespace limpid::HWY_NAMESPACE {
namespace {

/// `count` texels of a row; lanes beyond repeat the last texel.
LIMPID_LANES_INLINE Lane load(const float* from, std::ptrdiff_t x_stride, int count) {
  if (x_stride == 1 && count >= kLanes) return Lane(hn::LoadU(kD, from));
  alignas(64) float buffer[kLanes];
  for (int i = 0; i < kLanes; ++i) buffer[i] = from[(i < count ? i : count - 1) * x_stride];
  return Lane(hn::Load(kD, buffer));
}

LIMPID_LANES_INLINE float sum(Lane v) {
  alignas(64) float lanes[kLanes];
  hn::Store(v.v, kD, lanes);
  float result = 0;
  for (int i = 0; i < kLanes; ++i) result += lanes[i];
  return result;
}

/// A row of a view, by columns.
struct Row {
  const float* data;
  std::ptrdiff_t x_stride, y_stride;
  bool more;  ///< whether another row will be read after this row

  LIMPID_LANES_INLINE Row(const View<const float>& view, const Rect& pixels, int y)
      : data(view.data + std::ptrdiff_t{y - view.window.y0} * view.y_stride -
             std::ptrdiff_t{view.window.x0} * view.x_stride),
        x_stride(view.x_stride),
        y_stride(view.y_stride),
        more(y + 1 < pixels.y1) {}

  LIMPID_LANES_INLINE Lane at(int x, int count) const {
    return load(data + x * x_stride, x_stride, count);
  }
  /// Rows lie pages apart, where the hardware does not prefetch: each row prefetches the next one.
  LIMPID_LANES_INLINE void ask_for_next(int x) const {
    if (more) __builtin_prefetch(data + x * x_stride + y_stride);
  }
};

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

/// Calls visit(x, count) for the vectors of a block; count is a constant for whole ones.
template <class Visit>
LIMPID_LANES_INLINE void for_each_vector(int x0, int x1, Visit&& visit) {
  int x = x0;
  for (; x + kLanes <= x1; x += kLanes) visit(x, kLanes);
  if (x < x1) visit(x, x1 - x);
}

struct RangeLanes {
  Lane low{HUGE_VAL}, high{-HUGE_VAL};
};

void range(const View<const float>& view, const Rect& pixels, Blocks blocks, SeenRange* out) {
  RangeLanes lanes[Blocks::kMost];
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    const Row row(view, pixels, y);
    for_each_block(pixels, blocks, [&](int block, int x0, int x1) {
      Lane low = lanes[block].low, high = lanes[block].high;
      for_each_vector(x0, x1, [&](int x, int count) {
        row.ask_for_next(x);
        const Lane value = row.at(x, count);
        low = min(low, value);
        high = max(high, value);
      });
      lanes[block].low = low, lanes[block].high = high;
    });
  }
  for_each_block(pixels, blocks, [&](int block, int, int) {
    out[block] = {least(lanes[block].low), greatest(lanes[block].high)};
  });
}

/// The surface, and whether it lies in front of the dry scene.
struct Surface {
  Lane near, far;
  Mask may, must;
};

/// The calm plane: |over| / under with `under` counted towards it, each off by its error.
LIMPID_LANES_INLINE Surface calm(const RowRays<Lane>& rays, const HeightError& error, Lane x,
                                 Lane dry, bool farthest) {
  const Lane infinite(HUGE_VAL), off(error.over);
  const Lane over = rays.calm_over + x * rays.calm_over_dx;
  const Lane along = rays.calm_under + x * rays.calm_under_dx;
  const Lane height = abs(over);
  const Lane under = select(over < Lane(0), Lane(0) - along, along);
  const Lane most = under + Lane(error.under), surely = under - Lane(error.under);
  // An eye that may lie in the plane itself may see water anywhere.
  const Mask beside = height <= off;
  const Mask meets = most > Lane(0), sure = surely > Lane(0) && !beside;
  const Lane far = select(sure, (height + off) / select(sure, surely, Lane(1)), infinite);
  Lane near(0);
  if (farthest) near = select(beside, near, (height - off) / select(meets, most, Lane(1)));
  return {near, far, beside || (meets && height - off < most * dry), far < dry};
}

struct WetLanes {
  Lane wet{0}, sure{0}, surface_near{HUGE_VAL}, surface_far{0}, own_near{HUGE_VAL}, own_far{0};

  // Member by member: compilers copy the whole struct in pieces smaller than a vector.
  LIMPID_LANES_INLINE WetLanes copy() const {
    return {wet, sure, surface_near, surface_far, own_near, own_far};
  }
  LIMPID_LANES_INLINE void take(const WetLanes& w) {
    wet = w.wet, sure = w.sure;
    surface_near = w.surface_near, surface_far = w.surface_far;
    own_near = w.own_near, own_far = w.own_far;
  }

  LIMPID_LANES_INLINE void add(Lane dry, Surface water, bool farthest) {
    const Lane infinite(HUGE_VAL), zero(0), one(1);
    wet = wet + select(water.may, one, zero);
    sure = sure + select(water.must, one, zero);
    surface_far = max(surface_far, select(water.may, water.far, zero));
    const Lane between = select(water.must, dry - water.far, zero);
    own_near = min(own_near, select(water.may, between, infinite));
    if (!farthest) return;
    surface_near = min(surface_near, select(water.may, water.near, infinite));
    own_far = max(own_far, select(water.may, dry - water.near, zero));
  }
};

/// water_at(x, count, dry): the surface of `count` pixels from the column x on.
template <class WaterAt>
LIMPID_LANES_INLINE void add_row(const Row& depths, const Rect& pixels, Blocks blocks,
                                 bool farthest, WetLanes* lanes, WaterAt&& water_at) {
  for_each_block(pixels, blocks, [&](int block, int x0, int x1) {
    WetLanes w = lanes[block].copy();
    for_each_vector(x0, x1, [&](int x, int count) {
      depths.ask_for_next(x);
      const Lane dry = depths.at(x, count);
      Surface water = water_at(x, count, dry);
      if (count < kLanes) {
        const Mask inside = Lane(hn::Iota(kD, 0.0f)) < Lane(count);
        water.may = water.may && inside, water.must = water.must && inside;
      }
      w.add(dry, water, farthest);
    });
    lanes[block].take(w);
  });
}

template <bool kFarthest>
LIMPID_LANES_INLINE void add_rows(const WaterView& view, const HeightError& error,
                                  const View<const float>& depth, const View<const float>& surface,
                                  const Rect& pixels, Blocks blocks, WetLanes* lanes) {
  const Lane steps(hn::Iota(kD, 0.0f));  // made of scalars: not in the loop
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    const Row depths(depth, pixels, y);
    if (surface.data) {
      const Row surfaces(surface, pixels, y);
      add_row(depths, pixels, blocks, kFarthest, lanes, [&](int x, int count, Lane dry) {
        surfaces.ask_for_next(x);
        const Lane water = surfaces.at(x, count);
        const Mask wet = water < dry;
        return Surface{water, water, wet, wet};
      });
    } else {
      const RowRays<Lane> rays(view, y - view.corner.y + 0.5);
      add_row(depths, pixels, blocks, kFarthest, lanes, [&](int x, int, Lane dry) {
        const Lane column = steps + Lane(x - view.corner.x + 0.5);
        return calm(rays, error, column, dry, kFarthest);
      });
    }
  }
}

/// Calls visit(block, y, x, count, z, over, under) for the vectors of texels at eye depth z, whose
/// rays have the height over + z under there.
template <class Visit>
LIMPID_LANES_INLINE void for_each_height(const WaterView& view, const View<const float>& depth,
                                         const Rect& pixels, Blocks blocks, Visit&& visit) {
  const Lane steps(hn::Iota(kD, 0.0f));
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    const Row row(depth, pixels, y);
    const RowRays<Lane> rays(view, y - view.corner.y + 0.5);
    for_each_block(pixels, blocks, [&](int block, int x0, int x1) {
      for_each_vector(x0, x1, [&](int x, int count) {
        row.ask_for_next(x);
        // Lanes beyond the end of a row repeat the ray of its last texel.
        const Lane column = min(steps, Lane(count - 1)) + Lane(x - view.corner.x + 0.5);
        const Lane over = Lane(0) - (rays.calm_over + column * rays.calm_over_dx);
        const Lane under = rays.calm_under + column * rays.calm_under_dx;
        visit(block, y, x, count, row.at(x, count), over, under);
      });
    });
  }
}

void highest_water(const WaterView& view, const View<const float>& surface, const Rect& pixels,
                   Blocks blocks, float* out) {
  Lane lanes[Blocks::kMost];
  for (Lane& highest : lanes) highest = Lane(-HUGE_VAL);
  for_each_height(view, surface, pixels, blocks,
                  [&](int block, int, int, int, Lane z, Lane over, Lane under) {
                    const Lane height = select(z < Lane(1e30), over + z * under, Lane(-HUGE_VAL));
                    lanes[block] = max(lanes[block], height);
                  });
  for_each_block(pixels, blocks, [&](int block, int, int) { out[block] = greatest(lanes[block]); });
}

/// Error of heights: a lookup's ray passes up to half a texel from the centre of its texel, plus
/// rounding.
struct RayError {
  Lane over, under;

  LIMPID_LANES_INLINE RayError(const WaterView& c, const HeightError& error)
      : over(error.over + half_texel(c, c.over_step)),
        under(error.under + half_texel(c, c.under_step)) {}
  LIMPID_LANES_INLINE Lane at(Lane z) const { return over + abs(z) * under; }

 private:
  static double half_texel(const WaterView& c, const glm::dvec2& step) {
    return 0.51 * (__builtin_fabs(step.x) / c.size.x + __builtin_fabs(step.y) / c.size.y);
  }
};

struct HeightLanes {
  Lane highest{-HUGE_VAL}, deepest{-HUGE_VAL}, covers{-HUGE_VAL};
};

void seen_heights(const WaterView& view, const SeenFrom& from, const View<const float>& depth,
                  const View<const float>& surface, const Rect& pixels, Blocks blocks,
                  SeenHeights* out) {
  const RayError off_by(view, from.error);
  const Lane infinite(HUGE_VAL), none(-HUGE_VAL), far(1e30);
  const bool covers = from.path_fraction > 0;
  const Lane share(covers ? from.path_fraction : 1);
  HeightLanes lanes[Blocks::kMost];
  for_each_height(view, depth, pixels, blocks,
                  [&](int block, int y, int x, int count, Lane z, Lane over, Lane under) {
                    HeightLanes& all = lanes[block];
                    const Mask down = under + off_by.under < Lane(0), some = z < far;
                    const Lane height = over + z * under, off = off_by.at(z);
                    const Lane upper = select(down, height + off, infinite);
                    const Lane under_water = select(height - off > Lane(from.most), none, upper);
                    all.highest = max(all.highest, select(some, under_water, none));
                    all.deepest = max(all.deepest, select(some, off - height, infinite));
                    if (!covers) return;
                    // Points under the calm surface are farther away.
                    Lane water = select(over > off_by.over, Lane(0) - off, none);
                    if (surface.data) {
                      const Lane at = Row(surface, pixels, y).at(x, count);
                      const Lane wave = over + at * under - off_by.at(at);
                      water = select(at < far, wave, from.calm_ashore ? water : none);
                    }
                    const Lane end = (upper - (Lane(1) - share) * water) / share;
                    all.covers = max(all.covers, select(some && upper < water, end, infinite));
                  });
  for_each_block(pixels, blocks, [&](int block, int, int) {
    const HeightLanes& all = lanes[block];
    out[block] = {greatest(all.highest), greatest(all.deepest),
                  covers ? greatest(all.covers) : HUGE_VALF};
  });
}

void seen_depths(const WaterView& view, const HeightError& error, const View<const float>& depth,
                 bool above, const Rect& pixels, Blocks blocks, SeenRange* out) {
  const RayError off_by(view, error);
  const Mask above_alone = Lane(above ? 1 : 0) > Lane(0);
  RangeLanes lanes[Blocks::kMost];
  for_each_height(view, depth, pixels, blocks,
                  [&](int block, int, int, int, Lane z, Lane over, Lane under) {
                    const Mask counts = !(over + z * under + off_by.at(z) < Lane(0));
                    const Mask some = z < Lane(1e30) && (counts || !above_alone);
                    RangeLanes& all = lanes[block];
                    all.low = min(all.low, select(some, z, Lane(HUGE_VAL)));
                    all.high = max(all.high, select(some, z, Lane(-HUGE_VAL)));
                  });
  for_each_block(pixels, blocks, [&](int block, int, int) {
    out[block] = {least(lanes[block].low), greatest(lanes[block].high)};
  });
}

void wet(const WaterView& view, const HeightError& error, const View<const float>& depth,
         const View<const float>& surface, const Rect& pixels, Blocks blocks, bool farthest,
         WetSeen* out) {
  WetLanes lanes[Blocks::kMost];
  if (farthest) {
    add_rows<true>(view, error, depth, surface, pixels, blocks, lanes);
  } else {
    add_rows<false>(view, error, depth, surface, pixels, blocks, lanes);
  }
  for_each_block(pixels, blocks, [&](int block, int, int) {
    const WetLanes& w = lanes[block];
    const float infinite = static_cast<float>(HUGE_VAL);
    out[block] = {static_cast<int>(sum(w.wet)),
                  static_cast<int>(sum(w.sure)),
                  farthest ? least(w.surface_near) : 0,
                  greatest(w.surface_far),
                  least(w.own_near),
                  farthest ? greatest(w.own_far) : infinite};
  });
}

}  // namespace
}  // namespace limpid::HWY_NAMESPACE

namespace limpid {

extern const ScanTarget LIMPID_OF_TARGET(kScan_);
const ScanTarget LIMPID_OF_TARGET(kScan_) = {HWY_NAMESPACE::range, HWY_NAMESPACE::highest_water,
                                             HWY_NAMESPACE::seen_heights,
                                             HWY_NAMESPACE::seen_depths, HWY_NAMESPACE::wet};

}  // namespace limpid

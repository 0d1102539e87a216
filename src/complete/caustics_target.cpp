// Compiled once for each instruction set, under the same rules as run/lanes_target.cpp.
#include "complete/caustics_target.h"

#include <cmath>

#include "core/fetch.h"
#include "core/lanes.h"
#include "core/target_name.h"
#include "optics/fresnel.h"

namespace limpid::HWY_NAMESPACE {
namespace {

/// Rows have room for whole vectors. The sines and cosines of a vector are rotated to those of the
/// next vector, and computed anew before rounding adds up.
void add_sines(std::span<const SineOfRow> sines, int count, const SurfaceRow& to) {
  constexpr int kTurns = 64;
  constexpr double kTurn = 6.283185307179586;
  const Lane iota(hn::Iota(kD, 0.0f));
  for (const SineOfRow& wave : sines) {
    const Lane turn_cos(std::cos(kLanes * wave.step)), turn_sin(std::sin(kLanes * wave.step));
    const Lane amplitude(wave.amplitude), slope_x(wave.slope_x), slope_y(wave.slope_y);
    const Lane own = Lane(std::fmod(wave.step, kTurn)) * iota;
    Lane cosine(1), sine(0);
    for (int i = 0; i < count; i += kLanes) {
      if (i % (kLanes * kTurns) == 0) {
        const Lane phase = Lane(std::fmod(wave.phase + i * wave.step, kTurn)) + own;
        cosine = cos(phase), sine = sin(phase);
      }
      const auto add = [&](float* row, Lane value) LIMPID_LANES_LAMBDA {
        hn::StoreU(hn::Add(hn::LoadU(kD, row + i), value.v), kD, row + i);
      };
      add(to.height, amplitude * sine);
      add(to.slope_x, slope_x * cosine);
      add(to.slope_y, slope_y * cosine);
      const Lane turned = cosine * turn_cos - sine * turn_sin;
      sine = sine * turn_cos + cosine * turn_sin;
      cosine = turned;
    }
  }
}

void read_tile(const TileRow& tile, int count, const SurfaceRow& to) {
  const Lane iota(hn::Iota(kD, 0.0f)), step(tile.step), texels(tile.texels),
      per_tile(1.0 / tile.texels), last(tile.texels - 1);
  for (int i = 0; i < count; i += kLanes) {
    const Lane straight = Lane(std::fmod(tile.first + i * tile.step, tile.texels)) + step * iota;
    const Lane at = max(straight - texels * floor(straight * per_tile), Lane(0));
    const Lane column = min(floor(at), last);
    const VI whole = whole_of(column);
    const VI places = hn::Add(whole, whole);
    const Pair left = fetch_pairs(tile.slopes, places),
               right = fetch_pairs(tile.slopes + 2, places);
    const Lane u = at - column;
    hn::StoreU(lerp(left.left, right.left, u).v, kD, to.slope_x + i);
    hn::StoreU(lerp(left.right, right.right, u).v, kD, to.slope_y + i);
  }
}

void read_normals(const NormalRow& row, int count, const SurfaceRow& to) {
  const Rect& window = row.normal[0].window;
  const int width = window.x1 - window.x0, height = window.y1 - window.y0;
  const Lane iota(hn::Iota(kD, 0.0f)), none(0), last_x(width - 1), last_y(height - 1);
  const Lane last_column(width > 1 ? width - 2 : 0), last_row(height > 1 ? height - 2 : 0);
  for (int i = 0; i < count; i += kLanes) {
    const auto at = [&](const EvenRow& even) LIMPID_LANES_LAMBDA {
      return Lane(even.first + i * even.step) + Lane(even.step) * iota;
    };
    const Lane w = at(row.w), x = at(row.u) / w, y = at(row.v) / w;
    const Mask seen = w > none && x >= none && x <= last_x && y >= none && y <= last_y;
    Lane slope_x = none, slope_y = none;
    if (any(seen)) {
      const Lane column = select(seen, min(floor(x), last_column), none);
      const Lane line = select(seen, min(floor(y), last_row), none);
      const Lane u = x - column, v = y - line;
      const auto read = [&](const View<const float>& view) LIMPID_LANES_LAMBDA {
        const int x_stride = static_cast<int>(view.x_stride);
        const int y_stride = static_cast<int>(view.y_stride);
        const VI upper = hn::Add(hn::Mul(whole_of(column), hn::Set(kDI, x_stride)),
                                 hn::Mul(whole_of(line), hn::Set(kDI, y_stride)));
        const int right = width > 1 ? x_stride : 0, down = height > 1 ? y_stride : 0;
        const auto mixed = [&](const float* data) LIMPID_LANES_LAMBDA {
          if (right != 1) return lerp(fetch(data, upper), fetch(data + right, upper), u);
          const Pair pair = fetch_pairs(data, upper);
          return lerp(pair.left, pair.right, u);
        };
        return lerp(mixed(view.data), mixed(view.data + down), v);
      };
      const Lane n[3] = {read(row.normal[0]), read(row.normal[1]), read(row.normal[2])};
      const auto along = [&](const Vec3<float>& axis) LIMPID_LANES_LAMBDA {
        return n[0] * Lane(axis.x) + n[1] * Lane(axis.y) + n[2] * Lane(axis.z);
      };
      const Lane per_up = Lane(-1) / max(along(row.up), Lane(row.least_up));
      slope_x = select(seen, along(row.map_x) * per_up, none);
      slope_y = select(seen, along(row.map_y) * per_up, none);
    }
    hn::StoreU(slope_x.v, kD, to.slope_x + i);
    hn::StoreU(slope_y.v, kD, to.slope_y + i);
  }
}

struct Bottom {
  const LightRow& light;

  static LIMPID_LANES_INLINE Lane within(Lane at, int count) {
    return min(max(at, Lane(0)), Lane(count - 1));
  }
  LIMPID_LANES_INLINE Lane cell_of(Lane at) const {
    return at * Lane(light.per_cell) + Lane(light.cell_x);
  }
  LIMPID_LANES_INLINE VI index(VI x, VI y) const {
    return hn::Add(hn::Mul(y, hn::Set(kDI, light.across)), x);
  }
  LIMPID_LANES_INLINE Lane nearest(Lane x, Lane y) const {
    const VI column = whole_of(within(cell_of(x) + Lane(0.5), light.across));
    const VI row = whole_of(within(cell_of(y) + Lane(0.5), light.down));
    return fetch(light.bottom, index(column, row));
  }
  /// Bilinear between cells; across an edge, the depth of the nearest cell.
  LIMPID_LANES_INLINE Lane between(Lane x, Lane y) const {
    const Lane at_x = within(cell_of(x), light.across - 1),
               at_y = within(cell_of(y), light.down - 1);
    const Lane column = floor(at_x), row = floor(at_y);
    const VI upper = index(whole_of(column), whole_of(row));
    const Pair top = fetch_pairs(light.bottom, upper);
    const Pair low = fetch_pairs(light.bottom + light.across, upper);
    const Lane deepest = max(max(top.left, top.right), max(low.left, low.right));
    const Lane highest = min(min(top.left, top.right), min(low.left, low.right));
    const Mask edge = deepest - highest > Lane(light.edge);
    const auto share = [&](Lane at) LIMPID_LANES_LAMBDA {
      return select(edge, select(at < Lane(0.5), Lane(0), Lane(1)), at);
    };
    const Lane u = share(at_x - column), v = share(at_y - row);
    return lerp(lerp(top.left, top.right, u), lerp(low.left, low.right, u), v);
  }
};

void follow(const LightRow& light, int count, const SurfaceRow& surface, const LitRow& to) {
  const Bottom bottom{light};
  const Lane iota(hn::Iota(kD, 0.0f)), one(1), row_y(light.at_y), per_length(light.per_length);
  const Lane unbent(1 - double{light.eta} * light.eta);
  const Lane sun_x(light.sun_x), sun_y(light.sun_y), sun_z(light.sun_z), eta(light.eta);
  for (int i = 0; i < count; i += kLanes) {
    const Lane slope_x(hn::LoadU(kD, surface.slope_x + i)),
        slope_y(hn::LoadU(kD, surface.slope_y + i));
    const Lane height(hn::LoadU(kD, surface.height + i));
    // Snell's law for the normal (-slope_x, -slope_y, 1) without normalising it: cosines are times
    // its length, and `bend` is its share in the light's direction, times the square of that
    // length.
    const Lane facing = sun_z - sun_x * slope_x - sun_y * slope_y;
    const Lane square = one + slope_x * slope_x + slope_y * slope_y;
    const Lane bend = eta * facing - sqrt(unbent * square + eta * eta * facing * facing);
    const Lane per_sink = one / max(eta * sun_z * square - bend, Lane(0.02) * square);
    const Lane aside_x = (Lane(0) - (eta * sun_x * square + bend * slope_x)) * per_sink;
    const Lane aside_y = (Lane(0) - (eta * sun_y * square + bend * slope_y)) * per_sink;
    const Lane gain_x = (aside_x - Lane(light.calm_x)) * per_length;
    const Lane gain_y = (aside_y - Lane(light.calm_y)) * per_length;
    const Lane row_x = Lane(light.first_x) + Lane(light.step_x) * (Lane(i) + iota);
    const Lane from_x = row_x + height * per_length * aside_x;
    const Lane from_y = row_y + height * per_length * aside_y;
    const Lane first = bottom.nearest(row_x, row_y);
    const Lane depth = bottom.between(from_x + first * gain_x, from_y + first * gain_y);
    const Lane x = from_x + depth * gain_x, y = from_y + depth * gain_y;
    Lane power = max(facing, Lane(0)) * Lane(light.share);
    const Mask rises = first - depth > Lane(light.edge);
    if (any(rises)) {
      // A ray past the edge continues down to the shadow of the edge, for which calm water has no
      // entry point.
      const Mask passes = rises && bottom.nearest(x, y) - depth > Lane(light.edge);
      power = select(passes, Lane(0), power);
    }
    if (light.per_calm > 0) {
      const Lane cosine = facing / sqrt(square);
      power = power * Lane(light.per_calm) * (one - fresnel_exact(cosine, Lane(light.ior)));
    }
    hn::StoreU(x.v, kD, to.x + i);
    hn::StoreU(y.v, kD, to.y + i);
    hn::StoreU(power.v, kD, to.power + i);
  }
}

/// Parts of a row whose rays alternate; spread() ends rows with as many rays without light.
constexpr int kTurns = 8;

/// Of a box as wide as the ray, around it, what lies on each of four texels from the first one on:
/// `wide` in all. A ray is at least a texel wide, or the table would be grainy where light is
/// focused.
struct Parts {
  Lane first, wide, parts[4];

  LIMPID_LANES_INLINE Parts(Lane at, Lane along, Lane across, Lane widest) {
    const Lane one(1), square = along * along + across * across;
    wide = sqrt(min(max(square, Lane(1)), widest * widest));
    const Lane begin = at - Lane(0.5) * wide + Lane(0.5);
    first = floor(begin);
    const Lane rest = first + one - begin;
    const Lane until = min(rest, wide), next = min(rest + one, wide);
    const Lane third = min(rest + one + one, wide);
    parts[0] = until, parts[1] = next - until, parts[2] = third - next, parts[3] = wide - third;
  }
  LIMPID_LANES_INLINE Mask within(int count) const {
    return first > Lane(-3) && first < Lane(count);
  }
};

RowsHit spread(const BeamRow& beams, int count, const SplatRow& to) {
  const Lane half(0.5), none(0), widest(beams.widest);
  const auto load = [](const float* at) LIMPID_LANES_LAMBDA { return Lane(hn::LoadU(kD, at)); };
  Lane least_row(1e9), most_row(-1e9);
  for (int i = 0; i < count + kTurns; i += kLanes) {
    const auto parts = [&](const float* above, const float* here,
                           const float* below) LIMPID_LANES_LAMBDA {
      return Parts(load(here + i), half * (load(here + i + 1) - load(here + i - 1)),
                   half * (load(below + i) - load(above + i)), widest);
    };
    const Parts x = parts(beams.above.x, beams.here.x, beams.below.x);
    const Parts y = parts(beams.above.y, beams.here.y, beams.below.y);
    const Mask counted = Lane(hn::ConvertTo(kD, count_from(i))) < Lane(count);
    const Mask inside = x.within(beams.width) && y.within(beams.height) && counted;
    const Lane power = select(inside, load(beams.here.power + i) / (x.wide * y.wide), none);
    const Lane row = select(inside, y.first, Lane(-3));
    const VI line = hn::Mul(whole_of(row + Lane(3)), hn::Set(kDI, beams.stride));
    const VI texel = hn::Add(line, whole_of(select(inside, x.first, Lane(-3)) + Lane(3)));
    hn::StoreU(texel, kDI, to.texel + i);
    hn::StoreInterleaved4((power * x.parts[0]).v, (power * x.parts[1]).v, (power * x.parts[2]).v,
                          (power * x.parts[3]).v, kD, to.along + 4 * i);
    hn::StoreInterleaved4(y.parts[0].v, y.parts[1].v, y.parts[2].v, y.parts[3].v, kD,
                          to.down + 4 * i);
    least_row = min(least_row, select(inside, y.first, Lane(1e9)));
    most_row = max(most_row, select(inside, y.first, Lane(-1e9)));
  }
  const float first = least(least_row), last = greatest(most_row);
  if (first > last) return {0, -1};
  return {static_cast<int>(first), static_cast<int>(last) + beams.widest};
}

/// Rays side by side hit the same texels, and a load waits for a store that it overlaps in part:
/// rays of several parts of the row take turns.
template <int kRows>
void splat_rows(const SplatRow& from, int count, int stride, float* light) {
  const int each = (count + kTurns - 1) / kTurns;
  for (int i = 0; i < each; ++i) {
    for (int turn = 0; turn < kTurns; ++turn) {
      const int ray = turn * each + i;
      float* texel = light + from.texel[ray];
      const float *along = from.along + 4 * ray, *down = from.down + 4 * ray;
      for (int row = 0; row < kRows; ++row) {
        float sum[4];  // all are read before one is written: that may be a vector
        for (int k = 0; k < 4; ++k) sum[k] = texel[row * stride + k] + down[row] * along[k];
        for (int k = 0; k < 4; ++k) texel[row * stride + k] = sum[k];
      }
    }
  }
}

void splat(const SplatRow& from, int count, int stride, int widest, float* light) {
  if (widest == 2) return splat_rows<3>(from, count, stride, light);
  splat_rows<4>(from, count, stride, light);
}

Extremes filter(const FilterRow& row, int count, float* to) {
  const Lane half(0.5), spread(row.spread), blur(row.blur), most_blur(2.0 / 3);
  Lane lowest(1), highest(1);
  for (int i = 0; i < count; i += kLanes) {
    const auto load = [&](const float* at)
                          LIMPID_LANES_LAMBDA { return Lane(hn::LoadU(kD, at + i)); };
    const Lane middle = load(row.here), sides = half * (load(row.before) + load(row.after));
    const Lane depth = load(row.depth), share = min(spread * depth * depth - blur, most_blur);
    const Lane light = middle + share * (sides - middle);
    hn::StoreU(light.v, kD, to + i);
    const Mask counted = Lane(hn::ConvertTo(kD, count_from(i))) < Lane(count);
    const Lane one = select(counted, light, Lane(1));
    lowest = min(lowest, one), highest = max(highest, one);
  }
  return {least(lowest), greatest(highest)};
}

}  // namespace
}  // namespace limpid::HWY_NAMESPACE

namespace limpid {

extern const CausticsTarget LIMPID_OF_TARGET(kCaustics_);
const CausticsTarget LIMPID_OF_TARGET(kCaustics_) = {
    HWY_NAMESPACE::add_sines, HWY_NAMESPACE::read_tile, HWY_NAMESPACE::read_normals,
    HWY_NAMESPACE::follow,    HWY_NAMESPACE::spread,    HWY_NAMESPACE::splat,
    HWY_NAMESPACE::filter};

}  // namespace limpid

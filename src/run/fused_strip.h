#pragma once
#include "op/halve.h"
#include "op/pixel_start.h"
#include "run/aov_of.h"
#include "run/fused_tile.h"
#include "run/spot.h"
#include "run/wrapped.h"

/// The strip to which the fused pass applies operators: see op/operator.h. For inclusion by
/// lanes_target.cpp alone.

template <>
inline constexpr bool limpid::kLooksAhead<limpid::HWY_NAMESPACE::Lane> = true;

namespace limpid::HWY_NAMESPACE {

constexpr int kStripPixels = 256;
constexpr int kStripVectors = kStripPixels / kLanes;

/// Up to kStripPixels pixels of one row, in lanes, with their state in L1. Vectors without a wet
/// pixel are skipped.
class FusedStrip {
 public:
  using Number = Lane;

  LIMPID_LANES_INLINE FusedStrip(const FusedJob& job, int y, int x0, int x1)
      : job_(job),
        x0_(x0),
        y_(y),
        count_(x1 - x0),
        vectors_((x1 - x0 + kLanes - 1) / kLanes),
        width_(static_cast<float>(job.pass.size.x)),
        height_(static_cast<float>(job.pass.size.y)) {}

  /// Loads depths and starts each pixel with these parts of its state; false if no pixel is wet.
  bool begin(const RowRays<Lane>& rays, StateSet parts);
  void end() const;

  template <class Fn>
  LIMPID_LANES_INLINE void each(Fn&& fn) {
    for (const int v : wet()) fn(pixels_[v]);
  }

  template <class Into>
  LIMPID_LANES_INLINE void own(PlaneId plane, Into&& into) {
    const Source source = source_of(plane);
    for (const int v : wet()) into(pixels_[v], own_at(source, v));
  }

  template <class Into>
  LIMPID_LANES_INLINE void own3(PlaneId first, Into&& into) {
    const Source x = source_of(first), y = source_of(plane_after(first, 1)),
                 z = source_of(plane_after(first, 2));
    for (const int v : wet()) {
      into(pixels_[v], Vec3<Lane>{own_at(x, v), own_at(y, v), own_at(z, v)});
    }
  }

  template <class Into>
  LIMPID_LANES_INLINE void around3(PlaneId first, Into&& into) {
    const Source x = source_of(first), y = source_of(plane_after(first, 1)),
                 z = source_of(plane_after(first, 2));
    for (const int v : wet()) {
      Around<Lane> values;
      for (int k = 0; k < 9; ++k) {
        const int right = k % 3 - 1, down = k / 3 - 1;
        values.at[k] = {beside(x, v, right, down), beside(y, v, right, down),
                        beside(z, v, right, down)};
      }
      into(pixels_[v], values);
    }
  }

  template <class Where, class Into>
  LIMPID_LANES_INLINE void nearest(PlaneId plane, Where&& where, Into&& into) {
    for (const int v : wet()) into(pixels_[v], Tap{*this, v}.nearest(plane, where(pixels_[v])));
  }

  template <class Where, class Into>
  LIMPID_LANES_INLINE void bilinear(PlaneId plane, Where&& where, Into&& into) {
    const Source source = source_of(plane);
    if (!source.data) {
      for (const int v : wet()) into(pixels_[v], Lane(source.missing));
      return;
    }
    mixed<1>(&source, where,
             [&](Pixel<Lane>& p, const Lane* value) LIMPID_LANES_LAMBDA { into(p, value[0]); });
  }

  template <class Where, class Into>
  LIMPID_LANES_INLINE void bilinear_rgb(PlaneId first, Where&& where, Into&& into) {
    const Source sources[3] = {source_of(first), source_of(plane_after(first, 1)),
                               source_of(plane_after(first, 2))};
    if (sources[0].like(sources[1]) && sources[0].like(sources[2])) {
      return mixed<3>(sources, where, [&](Pixel<Lane>& p, const Lane* value) LIMPID_LANES_LAMBDA {
        into(p, Rgb<Lane>{value[0], value[1], value[2]});
      });
    }
    for (const int v : wet()) {
      const Vec2<Lane> shift = where(pixels_[v]);
      Lane value[3];
      for (int c = 0; c < 3; ++c) {
        value[c] = Lane(sources[c].missing);
        if (!sources[c].data) continue;
        sample<1, false>(&sources[c], spot_at<VI>(sources[c], v, shift), &value[c]);
      }
      into(pixels_[v], Rgb<Lane>{value[0], value[1], value[2]});
    }
  }

  template <class Where, class Into>
  LIMPID_LANES_INLINE void tiled_rgb(const Texture& texture, Where&& where, Into&& into) {
    tiled_rgb_of(texture, wet(), where, into);
  }

  template <class Wanted, class Where, class Into>
  LIMPID_LANES_INLINE void tiled_rgb_if(const Texture& texture, Wanted&& wanted, Where&& where,
                                        Into&& into) {
    int those[kStripVectors];
    tiled_rgb_of(texture, some(wanted, those), where, into);
  }

  template <class Width, class Where, class Into>
  LIMPID_LANES_INLINE void tiled_rgb(const Texture& texture, Width&& width, Where&& where,
                                     Into&& into) {
    int far[kStripVectors], near[kStripVectors];
    const auto not_far = [&](const Pixel<Lane>& p) LIMPID_LANES_LAMBDA {
      return !(share_of_levels(width(p)) >= Lane(1));
    };
    const auto not_near = [&](const Pixel<Lane>& p)
                              LIMPID_LANES_LAMBDA { return share_of_levels(width(p)) > Lane(0); };
    const Vectors with_far = texture.levels ? some(not_near, far) : Vectors{far, far};
    if (with_far.begin() == with_far.end()) return tiled_rgb_of(texture, wet(), where, into);
    Rgb<Lane> colors[kStripVectors];
    bool all_far[kStripVectors];
    for (const int v : with_far) {
      const Lane halves = max(Lane(0.5) * width(pixels_[v]), Lane(1));
      colors[v] = levels_rgb(*texture.levels, halves, where(pixels_[v]));
      all_far[v] = !any(not_far(pixels_[v]));
    }
    tiled_rgb_of(texture, some(not_far, near), where,
                 [&](Pixel<Lane>& p, Rgb<Lane> color) LIMPID_LANES_LAMBDA {
                   const Lane share = share_of_levels(width(p));
                   if (!any(share > Lane(0))) return into(p, color);
                   const Rgb<Lane> coarse = colors[&p - pixels_];
                   const Rgb<Lane> between = color + share * (coarse - color);
                   const Rgb<Lane> blurred = select(share >= Lane(1), coarse, between);
                   into(p, select(share > Lane(0), blurred, color));
                 });
    for (const int v : with_far) {
      if (all_far[v]) into(pixels_[v], colors[v]);
    }
  }

  template <class Wanted, class Width, class Where, class Into>
  LIMPID_LANES_INLINE void tiled_slopes_if(const SlopeLevels& levels, Wanted&& wanted,
                                           Width&& width, Where&& where, Into&& into) {
    int those[kStripVectors];
    for (const int v : some(wanted, those)) {
      const Pixel<Lane>& p = pixels_[v];
      into(pixels_[v], levels_slopes(levels, max(width(p), Lane(1)), where(p)));
    }
  }

  /// Lookups of a probe for the pixels of one vector.
  struct Tap {
    const FusedStrip& strip;
    int vector;

    LIMPID_LANES_INLINE Mask wet() const { return strip.wet_[vector]; }
    LIMPID_LANES_INLINE Lane own(PlaneId plane) const {
      return strip.own_at(strip.source_of(plane), vector);
    }
    LIMPID_LANES_INLINE Lane nearest(PlaneId plane, Vec2<Lane> shift) const {
      const Source source = strip.source_of(plane);
      if (!source.data) return Lane(source.missing);
      const Vec2<Lane> at = strip.in_texels(shift);
      return source.gather(nearest_place(source, strip.x0_ + vector * kLanes, strip.y_, at));
    }
    LIMPID_LANES_INLINE auto quad(Vec2<Lane> shift) const { return Quad(strip, vector, shift); }
    template <class Taps>
    LIMPID_LANES_INLINE Four<Lane> read(PlaneId plane, const Taps& q) const {
      const Source source = strip.source_of(plane);
      if (!source.data) {
        const Lane none(source.missing);
        return {none, none, none, none};
      }
      if (strip.job_.like_depth[index_of(plane)]) return q.pairs.read(source.data);
      if (has_pairs(source)) return QuadPairs(source, q.x, q.y).read(source.data);
      return {source.gather(inside(source, q.texel(0))), source.gather(inside(source, q.texel(1))),
              source.gather(inside(source, q.texel(2))), source.gather(inside(source, q.texel(3)))};
    }
    template <class Taps>
    LIMPID_LANES_INLINE Vec2<Lane> place(PlaneId plane, const Taps& q, int k) const {
      const Rect window = strip.source_of(plane).window;
      const Texel at = q.texel(k);
      const VI x = clamp(at.x, window.x0, window.x1 - 1);
      const VI y = clamp(at.y, window.y0, window.y1 - 1);
      return {Lane(hn::ConvertTo(kD, hn::Sub(x, strip.column(vector)))) / Lane(strip.width_),
              Lane(hn::ConvertTo(kD, hn::Sub(y, strip.row()))) / Lane(strip.height_)};
    }
    LIMPID_LANES_INLINE SeenHeights heights(PlaneId plane, Mask lanes, Vec2<Lane> from,
                                            Vec2<Lane> to) const {
      return all_between(strip.job_.pass.heights, plane, lanes, from, to);
    }
    LIMPID_LANES_INLINE SeenRange range(PlaneId plane, Mask lanes, Vec2<Lane> from,
                                        Vec2<Lane> to) const {
      const Pass& c = strip.job_.pass;
      const RangeBound& bound = plane == PlaneId::kSurfaceShadow ? c.lit : c.mirrored;
      if (plane != bound.plane) return {};
      return all_between(bound, plane, lanes, from, to);
    }
    LIMPID_LANES_INLINE Rgb<Lane> lat_long_rgb(const Texture& map, Vec2<Lane> at) const {
      return wrapped_rgb<false>(map, at);
    }
    LIMPID_LANES_INLINE Lane grid(const View<const float>& table, Vec2<Lane> at) const {
      const Source source(table, 0);
      Lane value;
      sample<1, true>(&source, Spot<VI>(source, at), &value);
      return value;
    }

   private:
    template <class Cell>
    LIMPID_LANES_INLINE Cell all_between(const BlockPyramid<Cell>& blocks, PlaneId plane,
                                         Mask lanes, Vec2<Lane> from, Vec2<Lane> to) const {
      if (!blocks.known) return {};
      const Rect w = strip.source_of(plane).window;
      const Vec2<Lane> a = strip.in_texels(from), b = strip.in_texels(to);
      const Lane iota(hn::Iota(kD, 0.0f));
      const Span x = span(lanes, strip.x0_ + vector * kLanes, iota + a.x, iota + b.x, w.x0, w.x1);
      const Span y = span(lanes, strip.y_, a.y, b.y, w.y0, w.y1);
      return blocks.of(x.low, y.low, x.high, y.high);
    }
  };

  template <class Fn>
  LIMPID_LANES_INLINE void probe(Fn&& fn) {
    for (const int v : wet()) fn(pixels_[v], Tap{*this, v});
  }

 private:
  /// A texel in the coordinates of the display window.
  struct Texel {
    VI x, y;
  };

  /// Texels low ... high along an axis.
  struct Span {
    int low, high;
  };
  /// The texels that these lanes, of which at least one is set, look up on the way from a to b,
  /// relative to the texel `own`. One more on each side, because rounding decides which texel is
  /// nearest.
  static LIMPID_LANES_INLINE Span span(Mask lanes, int own, Lane a, Lane b, int begin, int end) {
    const Lane first(begin - own), last(end - 1 - own);
    const auto inside = [&](Lane at)
                            LIMPID_LANES_LAMBDA { return min(max(floor(at), first), last); };
    const Lane low = inside(min(a, b) - Lane(1)), high = inside(max(a, b) + Lane(1));
    return {own + static_cast<int>(least(select(lanes, low, last))),
            own + static_cast<int>(greatest(select(lanes, high, first)))};
  }

  /// Four taps that a probe reads separately, k = 0 ... 3: upper left, upper right, lower left,
  /// lower right.
  struct Quad {
    VI x, y;
    Lane u, v;
    QuadPairs pairs;  ///< in planes with the layout of the depth, as most have

    LIMPID_LANES_INLINE Quad(const FusedStrip& strip, int vector, Vec2<Lane> shift) {
      const Vec2<Lane> at = tame(strip.in_texels(shift));
      u = at.x - floor(at.x);
      v = at.y - floor(at.y);
      x = whole(strip.column(vector), at.x);
      y = whole(strip.row(), at.y);
      const Source depth = strip.source_of(PlaneId::kDepth);
      if (has_pairs(depth)) pairs = QuadPairs(depth, x, y);
    }
    LIMPID_LANES_INLINE Lane weight(int k) const {
      return (k & 1 ? u : Lane(1) - u) * (k & 2 ? v : Lane(1) - v);
    }
    LIMPID_LANES_INLINE Texel texel(int k) const {
      return {hn::Add(x, hn::Set(kDI, k & 1)), hn::Add(y, hn::Set(kDI, k >> 1))};
    }
  };

  struct Vectors {
    const int *first, *last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
  };
  /// The vectors with a wet pixel.
  LIMPID_LANES_INLINE Vectors wet() const { return {order_, order_ + wet_vectors_}; }

  /// The wet vectors with a pixel that `such` accepts, stored in `room`.
  template <class Such>
  LIMPID_LANES_INLINE Vectors some(Such&& such, int* room) const {
    int count = 0;
    for (const int v : wet()) {
      if (any(such(pixels_[v]))) room[count++] = v;
    }
    return {room, room + count};
  }

  template <class Where, class Into>
  LIMPID_LANES_INLINE void tiled_rgb_of(const Texture& texture, Vectors vectors, Where&& where,
                                        Into&& into) {
    if (!texture.bytes) {
      for (const int v : vectors) into(pixels_[v], wrapped_rgb<true>(texture, where(pixels_[v])));
      return;
    }
    const Rect& window = texture.channels[0].window;
    const int width = window.x1 - window.x0, height = window.y1 - window.y0;
    BytesSpot spots[kStripVectors];
    for (const int v : vectors) spots[v] = BytesSpot(width, height, where(pixels_[v]));
    for (const int v : vectors) into(pixels_[v], bytes_rgb(texture.bytes, width, spots[v]));
  }

  /// Bilinear lookups in N channels of the same layout. All places first, then all texels.
  template <int N, class Where, class Into>
  LIMPID_LANES_INLINE void mixed(const Source* sources, Where&& where, Into&& into) {
    if (has_pairs(sources[0])) {
      mixed<N, true>(sources, where, into);
    } else {
      mixed<N, false>(sources, where, into);
    }
  }
  template <int N, bool kPairs, class Where, class Into>
  LIMPID_LANES_INLINE void mixed(const Source* sources, Where&& where, Into&& into) {
    Spot<Places> spots[kStripVectors];
    for (const int v : wet()) spots[v] = spot_at<Places>(sources[0], v, where(pixels_[v]));
    for (const int v : wet()) {
      Lane value[N];
      sample<N, kPairs>(sources, spots[v], value);
      into(pixels_[v], value);
    }
  }

  LIMPID_LANES_INLINE Vec2<Lane> in_texels(Vec2<Lane> shift) const {
    return {shift.x * Lane(width_), shift.y * Lane(height_)};
  }
  template <class At>
  LIMPID_LANES_INLINE Spot<At> spot_at(const Source& source, int vector, Vec2<Lane> shift) const {
    return Spot<At>(source, x0_ + vector * kLanes, y_, in_texels(shift));
  }

  /// Clamped to the range of int. NaN becomes the lower end.
  static LIMPID_LANES_INLINE Vec2<Lane> tame(Vec2<Lane> texels) {
    const Lane far(4e6), near(-4e6);
    return {min(max(texels.x, near), far), min(max(texels.y, near), far)};
  }
  static LIMPID_LANES_INLINE VI whole(VI from, Lane texels) {
    return hn::Add(from, whole_of(floor(texels)));
  }
  static LIMPID_LANES_INLINE VI inside(const Source& s, const Texel& at) {
    const VI x = clamp(at.x, s.window.x0, s.window.x1 - 1);
    const VI y = clamp(at.y, s.window.y0, s.window.y1 - 1);
    return s.index(hn::Sub(x, hn::Set(kDI, s.window.x0)), hn::Sub(y, hn::Set(kDI, s.window.y0)));
  }

  LIMPID_LANES_INLINE Source source_of(PlaneId plane) const {
    return {job_.frame.planes[index_of(plane)], job_.missing[index_of(plane)]};
  }
  LIMPID_LANES_INLINE VI column(int vector) const { return count_from(x0_ + vector * kLanes); }
  LIMPID_LANES_INLINE VI row() const { return hn::Set(kDI, y_); }
  LIMPID_LANES_INLINE int remaining(int vector) const { return count_ - vector * kLanes; }

  LIMPID_LANES_INLINE Lane own_at(const Source& s, int vector) const {
    if (!s.data) return Lane(s.missing);
    const std::ptrdiff_t down = std::ptrdiff_t{y_ - s.window.y0} * s.y_stride;
    const std::ptrdiff_t across = std::ptrdiff_t{x0_ + vector * kLanes - s.window.x0} * s.x_stride;
    return load_row(s.data + down + across, s.x_stride, remaining(vector));
  }
  /// Values of pixels beside these, or of the nearest pixels in the window.
  LIMPID_LANES_INLINE Lane beside(const Source& s, int vector, int right, int down) const {
    if (!s.data) return Lane(s.missing);
    const int y = std::clamp(y_ + down, s.window.y0, s.window.y1 - 1) - s.window.y0;
    const float* row = s.data + std::ptrdiff_t{y} * s.y_stride;
    const int x = x0_ + vector * kLanes + right - s.window.x0, last = s.width() - 1;
    if (s.x_stride == 1 && x >= 0 && x + kLanes - 1 <= last) return Lane(hn::LoadU(kD, row + x));
    alignas(64) float values[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      values[i] = row[std::ptrdiff_t{std::clamp(x + i, 0, last)} * s.x_stride];
    }
    return Lane(hn::Load(kD, values));
  }
  LIMPID_LANES_INLINE Rgb<Lane> color_at(const Source* rgb, int vector) const {
    return {own_at(rgb[0], vector), own_at(rgb[1], vector), own_at(rgb[2], vector)};
  }
  LIMPID_LANES_INLINE void store(const View<float>& to, int vector, Lane value) const {
    if (!to.data) return;
    const std::ptrdiff_t down = std::ptrdiff_t{y_ - to.window.y0} * to.y_stride;
    const std::ptrdiff_t across =
        std::ptrdiff_t{x0_ + vector * kLanes - to.window.x0} * to.x_stride;
    store_row(value, to.data + down + across, to.x_stride, remaining(vector));
  }

  /// `dry`: the dry color. A vector without a wet pixel has no state.
  void store_aovs(int vector, bool wet, Rgb<Lane> dry) const {
    const Pass& c = job_.pass;
    const Lane x = Lane(hn::ConvertTo(kD, column(vector))) + Lane(0.5 - c.corner.x);
    const Vec2<Lane> uv{x * Lane(1.0 / c.size.x), Lane((y_ - c.corner.y + 0.5) / c.size.y)};
    for (int a = 0; a < kAovCount; ++a) {
      const std::array<View<float>, 3>& views = job_.target.aovs[a];
      if (!views[0].data) continue;
      const Aov aov = static_cast<Aov>(a);
      Vec3<Lane> value = dry_aov_of(aov, dry, uv, Lane(job_.dry_aov[a]));
      if (wet) value = select(wet_[vector], aov_of(pixels_[vector], aov), value);
      store(views[0], vector, value.x);
      store(views[1], vector, value.y);
      store(views[2], vector, value.z);
    }
  }

  const FusedJob& job_;
  int x0_, y_, count_, vectors_;
  float width_, height_;
  int wet_vectors_ = 0;
  int order_[kStripVectors];  ///< the first wet_vectors_ have a wet pixel
  Mask wet_[kStripVectors];
  Pixel<Lane> pixels_[kStripVectors];
};

inline bool FusedStrip::begin(const RowRays<Lane>& rays, StateSet parts) {
  const Pass& c = job_.pass;
  const Source surface = source_of(PlaneId::kSurfaceDepth), depth = source_of(PlaneId::kDepth);
  const Source color[3] = {source_of(PlaneId::kColorR), source_of(PlaneId::kColorG),
                           source_of(PlaneId::kColorB)};
  const bool takes_color = parts.has(StatePart::kTransmitted);
  for (int v = 0; v < vectors_; ++v) {
    const Lane x = Lane(hn::ConvertTo(kD, column(v))) + Lane(0.5 - c.corner.x);
    const Lane dry = own_at(depth, v);
    const Lane water = surface.data ? own_at(surface, v) : rays.calm_depth(x);
    const Mask in_picture = {
        hn::Lt(hn::Iota(kD, 0.0f), hn::Set(kD, static_cast<float>(remaining(v))))};
    const PixelStart<Lane> start(c, rays, x, water, dry, in_picture);
    wet_[v] = start.wet;
    if (!any(wet_[v])) continue;
    order_[wet_vectors_++] = v;
    Pixel<Lane>& p = pixels_[v];
    begin_pixel(c, rays, x, start.side, start.surface_depth, start.dry_depth, p);
    begin_state(parts, c, takes_color ? color_at(color, v) : Rgb<Lane>{}, p);
  }
  return wet_vectors_ > 0;
}

inline void FusedStrip::end() const {
  const Target& target = job_.target;
  const Source color[3] = {source_of(PlaneId::kColorR), source_of(PlaneId::kColorG),
                           source_of(PlaneId::kColorB)};
  const Source alpha = source_of(PlaneId::kColorA);
  int next = 0;  // index among the wet vectors
  for (int v = 0; v < vectors_; ++v) {
    const bool wet = next < wet_vectors_ && order_[next] == v;
    next += wet;
    const bool whole = wet && !any(!wet_[v]);
    Rgb<Lane> dry{}, out;
    Lane dry_alpha(1);
    if (!whole) {
      dry = color_at(color, v);
      if (alpha.data) dry_alpha = own_at(alpha, v);
    }
    out = !wet ? dry : whole ? pixels_[v].beauty() : select(wet_[v], pixels_[v].beauty(), dry);
    store(target.color[0], v, out.r);
    store(target.color[1], v, out.g);
    store(target.color[2], v, out.b);
    store(target.alpha, v, wet ? select(wet_[v], Lane(1), dry_alpha) : dry_alpha);
    if (job_.writes_aovs) store_aovs(v, wet, dry);
  }
}

}  // namespace limpid::HWY_NAMESPACE

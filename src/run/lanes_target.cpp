// Compiled once for each instruction set, with that set's flags and LIMPID_LANES_TARGET naming it.
// All that is instantiated here depends on the Lane type of the set, so that no function compiled
// for one machine can be linked into the path of another.
#include "core/lanes.h"
#include "run/fused_tile.h"

namespace limpid::HWY_NAMESPACE {
namespace {

constexpr int kStripPixels = 128;
constexpr int kStripVectors = kStripPixels / kLanes;

/// A channel of the frame, ready for lanes: index = y * y_stride + x * x_stride from `data`.
struct Source {
  const float* data;
  int x_stride, y_stride;
  Rect window;
  float missing;

  /// Whether the same index finds the same pixel in both.
  bool like(const Source& s) const {
    return x_stride == s.x_stride && y_stride == s.y_stride && window == s.window;
  }
};

LIMPID_LANES_INLINE Source source_of(const FusedJob& job, PlaneId plane) {
  const View<const float>& view = job.frame.planes[index_of(plane)];
  return {view.data, static_cast<int>(view.x_stride), static_cast<int>(view.y_stride), view.window,
          job.missing[index_of(plane)]};
}

/// A channel of a texture, with its corner at (0, 0).
LIMPID_LANES_INLINE Source source_of(const Texture& texture, int channel) {
  const View<const float>& view = texture.channels[channel];
  return {view.data,
          static_cast<int>(view.x_stride),
          static_cast<int>(view.y_stride),
          {0, 0, view.window.width(), view.window.height()},
          0};
}

LIMPID_LANES_INLINE VI clamp(VI x, int low, int high) {
  return hn::Min(hn::Max(x, hn::Set(kDI, low)), hn::Set(kDI, high));
}

/// `count` floats from a row into one vector; lanes beyond are 0. The full case is one unaligned
/// load.
LIMPID_LANES_INLINE Lane load_row(const float* from, int x_stride, int count) {
  if (x_stride == 1 && count >= kLanes) return Lane(hn::LoadU(kD, from));
  alignas(64) float buffer[kLanes] = {};
  for (int i = 0; i < count && i < kLanes; ++i) buffer[i] = from[i * x_stride];
  return Lane(hn::Load(kD, buffer));
}

LIMPID_LANES_INLINE void store_row(Lane value, float* to, std::ptrdiff_t x_stride, int count) {
  if (x_stride == 1 && count >= kLanes) {
    hn::StoreU(value.v, kD, to);
    return;
  }
  alignas(64) float buffer[kLanes];
  hn::Store(value.v, kD, buffer);
  for (int i = 0; i < count && i < kLanes; ++i) to[i * x_stride] = buffer[i];
}

/// Up to kStripPixels pixels of one row, in lanes, with their state in L1.
class FusedStrip {
 public:
  using Number = Lane;

  FusedStrip(const FusedJob& job, int y, int x0, int x1)
      : job_(job),
        x0_(x0),
        y_(y),
        count_(x1 - x0),
        vectors_((x1 - x0 + kLanes - 1) / kLanes),
        width_(static_cast<float>(job.context.size.x)),
        height_(static_cast<float>(job.context.size.y)) {}

  /// Loads depths and dry color and starts each pixel; false when none is wet.
  bool begin(const RowRays<Lane>& rays);
  void end() const;

  template <class Fn>
  LIMPID_LANES_INLINE void each(Fn&& fn) {
    for (int v = 0; v < vectors_; ++v) fn(pixels_[v]);
  }

  template <class Into>
  LIMPID_LANES_INLINE void own(PlaneId plane, Into&& into) {
    const Source source = source_of(job_, plane);
    for (int v = 0; v < vectors_; ++v) into(pixels_[v], own_at(source, v));
  }

  template <class Into>
  LIMPID_LANES_INLINE void own3(PlaneId first, Into&& into) {
    const Source x = source_of(job_, first);
    const Source y = source_of(job_, plane_after(first, 1));
    const Source z = source_of(job_, plane_after(first, 2));
    for (int v = 0; v < vectors_; ++v) {
      into(pixels_[v], Vec3<Lane>{own_at(x, v), own_at(y, v), own_at(z, v)});
    }
  }

  template <class Where, class Into>
  LIMPID_LANES_INLINE void nearest(PlaneId plane, Where&& where, Into&& into) {
    const Source source = source_of(job_, plane);
    if (!source.data) return missing(source, into);
    for (int v = 0; v < vectors_; ++v) {
      const Vec2<Lane> at = in_texels(where(pixels_[v]));
      const VI x = hn::Add(column(v), hn::ConvertTo(kDI, floor(at.x + Lane(0.5)).v));
      const VI y = hn::Add(hn::Set(kDI, y_), hn::ConvertTo(kDI, floor(at.y + Lane(0.5)).v));
      into(pixels_[v], gather(source, hn::Add(column_offset(source, x), row_offset(source, y))));
    }
  }

  template <class Where, class Into>
  LIMPID_LANES_INLINE void bilinear(PlaneId plane, Where&& where, Into&& into) {
    const Source source = source_of(job_, plane);
    if (!source.data) return missing(source, into);
    for (int v = 0; v < vectors_; ++v) {
      const Taps taps(*this, v, where(pixels_[v]));
      into(pixels_[v], taps.sample(source));
    }
  }

  template <class Where, class Into>
  LIMPID_LANES_INLINE void bilinear_rgb(PlaneId first, Where&& where, Into&& into) {
    const Source r = source_of(job_, first);
    const Source g = source_of(job_, plane_after(first, 1));
    const Source b = source_of(job_, plane_after(first, 2));
    const bool alike = g.like(r) && b.like(r);
    for (int v = 0; v < vectors_; ++v) {
      const Taps taps(*this, v, where(pixels_[v]));
      const Corners at = taps.corners(r);
      into(pixels_[v], Rgb<Lane>{taps.sample(r, at), taps.sample(g, alike ? at : taps.corners(g)),
                                 taps.sample(b, alike ? at : taps.corners(b))});
    }
  }

  template <class Where, class Into>
  LIMPID_LANES_INLINE void tiled_rgb(const Texture& texture, Where&& where, Into&& into) {
    const Source r = source_of(texture, 0), g = source_of(texture, 1), b = source_of(texture, 2);
    for (int v = 0; v < vectors_; ++v) {
      const WrappedTaps taps(r.window.width(), r.window.height(), where(pixels_[v]), true);
      into(pixels_[v], Rgb<Lane>{taps.sample(r), taps.sample(g), taps.sample(b)});
    }
  }

  /// What a probe may look up for the pixels of one vector.
  struct Tap {
    const FusedStrip& strip;
    int vector;

    LIMPID_LANES_INLINE Lane nearest(PlaneId plane, Vec2<Lane> shift) const {
      const Source source = source_of(strip.job_, plane);
      if (!source.data) return Lane(source.missing);
      const Vec2<Lane> at = strip.in_texels(shift);
      const VI x = hn::Add(strip.column(vector), hn::ConvertTo(kDI, floor(at.x + Lane(0.5)).v));
      const VI y = hn::Add(hn::Set(kDI, strip.y_), hn::ConvertTo(kDI, floor(at.y + Lane(0.5)).v));
      return gather(source, hn::Add(column_offset(source, x), row_offset(source, y)));
    }
    LIMPID_LANES_INLINE auto quad(Vec2<Lane> shift) const { return Taps(strip, vector, shift); }
    template <class Quad>
    LIMPID_LANES_INLINE Lane read(PlaneId plane, const Quad& q, int k) const {
      const Source source = source_of(strip.job_, plane);
      if (!source.data) return Lane(source.missing);
      return gather(source, hn::Add(column_offset(source, k & 1 ? q.x1 : q.x0),
                                    row_offset(source, k & 2 ? q.y1 : q.y0)));
    }
    template <class Quad>
    LIMPID_LANES_INLINE Vec2<Lane> place(PlaneId plane, const Quad& q, int k) const {
      const Rect window = source_of(strip.job_, plane).window;
      const VI x = clamp(k & 1 ? q.x1 : q.x0, window.x0, window.x1 - 1);
      const VI y = clamp(k & 2 ? q.y1 : q.y0, window.y0, window.y1 - 1);
      return {Lane(hn::ConvertTo(kD, hn::Sub(x, strip.column(vector)))) / Lane(strip.width_),
              Lane(hn::ConvertTo(kD, hn::Sub(y, hn::Set(kDI, strip.y_)))) / Lane(strip.height_)};
    }
    LIMPID_LANES_INLINE Rgb<Lane> lat_long_rgb(const Texture& map, Vec2<Lane> at) const {
      const Source r = source_of(map, 0), g = source_of(map, 1), b = source_of(map, 2);
      const WrappedTaps taps(r.window.width(), r.window.height(), at, false);
      return {taps.sample(r), taps.sample(g), taps.sample(b)};
    }
  };

  template <class Fn>
  LIMPID_LANES_INLINE void probe(Fn&& fn) {
    for (int v = 0; v < vectors_; ++v) fn(pixels_[v], Tap{*this, v});
  }

 private:
  /// Indices of four taps in a channel.
  struct Corners {
    VI upper_left, upper_right, lower_left, lower_right;
  };

  /// Four taps and their weights, for any channel.
  struct Taps {
    VI x0, x1, y0, y1;
    Lane u, v;

    LIMPID_LANES_INLINE Taps(const FusedStrip& strip, int vector, Vec2<Lane> shift) {
      const Vec2<Lane> at = strip.in_texels(shift);
      const Lane whole_x = floor(at.x), whole_y = floor(at.y);
      u = at.x - whole_x;
      v = at.y - whole_y;
      x0 = hn::Add(strip.column(vector), hn::ConvertTo(kDI, whole_x.v));
      y0 = hn::Add(hn::Set(kDI, strip.y_), hn::ConvertTo(kDI, whole_y.v));
      x1 = hn::Add(x0, hn::Set(kDI, 1));
      y1 = hn::Add(y0, hn::Set(kDI, 1));
    }

    /// Of the tap k: upper left, upper right, lower left, lower right.
    LIMPID_LANES_INLINE Lane weight(int k) const {
      return (k & 1 ? u : Lane(1) - u) * (k & 2 ? v : Lane(1) - v);
    }

    LIMPID_LANES_INLINE Corners corners(const Source& s) const {
      const VI left = column_offset(s, x0), right = column_offset(s, x1);
      const VI upper = row_offset(s, y0), lower = row_offset(s, y1);
      return {hn::Add(left, upper), hn::Add(right, upper), hn::Add(left, lower),
              hn::Add(right, lower)};
    }

    LIMPID_LANES_INLINE Lane sample(const Source& s, const Corners& at) const {
      const Lane top = lerp(gather(s, at.upper_left), gather(s, at.upper_right), u);
      const Lane bottom = lerp(gather(s, at.lower_left), gather(s, at.lower_right), u);
      return lerp(top, bottom, v);
    }

    LIMPID_LANES_INLINE Lane sample(const Source& s) const { return sample(s, corners(s)); }
  };

  /// The same on a texture that repeats; positions in periods. Or that repeats in x alone:
  /// positions in y are 0 ... 1 then, and taps end at its edges.
  struct WrappedTaps {
    VI x0, x1, y0, y1;
    Lane u, v;

    LIMPID_LANES_INLINE WrappedTaps(int width, int height, Vec2<Lane> periods, bool both) {
      const Lane x = fraction(periods.x) * Lane(width) - Lane(0.5);
      const Lane y = (both ? fraction(periods.y) : periods.y) * Lane(height) - Lane(0.5);
      const Lane whole_x = floor(x), whole_y = floor(y);
      u = x - whole_x;
      v = y - whole_y;
      x0 = wrapped(hn::ConvertTo(kDI, whole_x.v), width);
      y0 = hn::ConvertTo(kDI, whole_y.v);
      x1 = wrapped(hn::Add(x0, hn::Set(kDI, 1)), width);
      y1 = hn::Add(y0, hn::Set(kDI, 1));
      y0 = both ? wrapped(y0, height) : clamp(y0, 0, height - 1);
      y1 = both ? wrapped(y1, height) : clamp(y1, 0, height - 1);
    }

    /// 0 for an infinite position, so that every tap lies in the texture.
    static LIMPID_LANES_INLINE Lane fraction(Lane x) {
      const Lane f = x - floor(x);
      return select(f >= Lane(0), f, Lane(0));
    }

    /// For -size <= i < 2 size.
    static LIMPID_LANES_INLINE VI wrapped(VI i, int size) {
      const VI n = hn::Set(kDI, size);
      const VI up = hn::IfThenElse(hn::Lt(i, hn::Zero(kDI)), hn::Add(i, n), i);
      return hn::IfThenElse(hn::Lt(up, n), up, hn::Sub(up, n));
    }

    LIMPID_LANES_INLINE Lane sample(const Source& s) const {
      const auto at = [&](VI x, VI y) {
        return gather(
            s, hn::Add(hn::Mul(x, hn::Set(kDI, s.x_stride)), hn::Mul(y, hn::Set(kDI, s.y_stride))));
      };
      return lerp(lerp(at(x0, y0), at(x1, y0), u), lerp(at(x0, y1), at(x1, y1), u), v);
    }
  };

  /// A shift in texels, kept to what an int can hold. (NaN becomes the lower end.)
  LIMPID_LANES_INLINE Vec2<Lane> in_texels(Vec2<Lane> shift) const {
    const Lane far(4e6);
    return {min(max(shift.x * Lane(width_), Lane(-4e6)), far),
            min(max(shift.y * Lane(height_), Lane(-4e6)), far)};
  }

  LIMPID_LANES_INLINE VI column(int vector) const { return hn::Iota(kDI, x0_ + vector * kLanes); }
  LIMPID_LANES_INLINE int remaining(int vector) const { return count_ - vector * kLanes; }

  static LIMPID_LANES_INLINE VI column_offset(const Source& s, VI x) {
    const VI inside = clamp(x, s.window.x0, s.window.x1 - 1);
    return hn::Mul(hn::Sub(inside, hn::Set(kDI, s.window.x0)), hn::Set(kDI, s.x_stride));
  }
  static LIMPID_LANES_INLINE VI row_offset(const Source& s, VI y) {
    const VI inside = clamp(y, s.window.y0, s.window.y1 - 1);
    return hn::Mul(hn::Sub(inside, hn::Set(kDI, s.window.y0)), hn::Set(kDI, s.y_stride));
  }
  static LIMPID_LANES_INLINE Lane gather(const Source& s, VI index) {
    return Lane(hn::GatherIndex(kD, s.data, index));
  }

  LIMPID_LANES_INLINE Lane own_at(const Source& s, int vector) const {
    if (!s.data) return Lane(s.missing);
    const std::ptrdiff_t row = std::ptrdiff_t{y_ - s.window.y0} * s.y_stride;
    const std::ptrdiff_t column = std::ptrdiff_t{x0_ + vector * kLanes - s.window.x0} * s.x_stride;
    return load_row(s.data + row + column, s.x_stride, remaining(vector));
  }

  template <class Into>
  LIMPID_LANES_INLINE void missing(const Source& s, Into&& into) {
    for (int v = 0; v < vectors_; ++v) into(pixels_[v], Lane(s.missing));
  }

  LIMPID_LANES_INLINE void store(const View<float>& to, int vector, Lane value) const {
    if (!to.data) return;
    const std::ptrdiff_t row = std::ptrdiff_t{y_ - to.window.y0} * to.y_stride;
    const std::ptrdiff_t column =
        std::ptrdiff_t{x0_ + vector * kLanes - to.window.x0} * to.x_stride;
    store_row(value, to.data + row + column, to.x_stride, remaining(vector));
  }

  const FusedJob& job_;
  int x0_, y_, count_, vectors_;
  float width_, height_;
  Mask wet_[kStripVectors];
  Pixel<Lane> pixels_[kStripVectors];
};

bool FusedStrip::begin(const RowRays<Lane>& rays) {
  const Context& c = job_.context;
  const Source surface = source_of(job_, PlaneId::kSurfaceDepth);
  const Source depth = source_of(job_, PlaneId::kDepth);
  const Source red = source_of(job_, PlaneId::kColorR);
  const Source green = source_of(job_, PlaneId::kColorG);
  const Source blue = source_of(job_, PlaneId::kColorB);
  bool any_wet = false;
  for (int v = 0; v < vectors_; ++v) {
    const Lane x = Lane(hn::ConvertTo(kD, column(v))) + Lane(0.5 - c.corner.x);
    const Lane dry = own_at(depth, v);
    const Lane water = surface.data ? own_at(surface, v) : rays.calm_depth(x);
    const Mask inside = {hn::Lt(hn::Iota(kD, 0.0f), hn::Set(kD, static_cast<float>(remaining(v))))};
    const Mask meets = water<dry, in_water = begins_in_water(c, rays, x)> Lane(0);
    wet_[v] = inside && (meets || in_water);
    any_wet = any_wet || any(wet_[v]);
    const Lane side = select(in_water, select(meets, Lane(-1), Lane(0)), Lane(1));
    // What a dry pixel gets instead keeps the formulas away from infinities; end() ignores the
    // result. A pixel that looks through water alone has no surface, but a finite number for it.
    const Lane other = select(in_water, min(dry, Lane(1e4)), Lane(1));
    begin_pixel(c, rays, x, side, select(meets, water, other), select(wet_[v], dry, Lane(2)),
                Rgb<Lane>{own_at(red, v), own_at(green, v), own_at(blue, v)}, pixels_[v]);
  }
  return any_wet;
}

void FusedStrip::end() const {
  const Target& target = job_.target;
  const Source alpha = source_of(job_, PlaneId::kColorA);
  for (int v = 0; v < vectors_; ++v) {
    const Pixel<Lane>& p = pixels_[v];
    const Rgb<Lane> dry{own_at(source_of(job_, PlaneId::kColorR), v),
                        own_at(source_of(job_, PlaneId::kColorG), v),
                        own_at(source_of(job_, PlaneId::kColorB), v)};
    const Rgb<Lane> out = select(wet_[v], p.beauty(), dry);
    store(target.color[0], v, out.r);
    store(target.color[1], v, out.g);
    store(target.color[2], v, out.b);
    const Lane opaque(1);
    store(target.alpha, v, select(wet_[v], opaque, alpha.data ? own_at(alpha, v) : opaque));
    for (int a = 0; a < kAovCount; ++a) {
      if (!target.aovs[a][0].data) continue;
      const Lane other(job_.dry_aov[a]);
      const Aov aov = static_cast<Aov>(a);
      const Vec3<Lane> value = select(wet_[v], aov_of(p, aov), dry_aov_of(aov, dry, p.uv, other));
      store(target.aovs[a][0], v, value.x);
      store(target.aovs[a][1], v, value.y);
      store(target.aovs[a][2], v, value.z);
    }
  }
}

void run_tile(const FusedJob& job, const Rect& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    const RowRays<Lane> rays(job.context, y - job.context.corner.y + 0.5);
    for (int x = tile.x0; x < tile.x1; x += kStripPixels) {
      const int end = x + kStripPixels < tile.x1 ? x + kStripPixels : tile.x1;
      FusedStrip strip(job, y, x, end);
      if (strip.begin(rays)) {
        Chain::for_each([&]<class Op, int I>() {
          if (job.keeps[I]) {
            Op::apply(std::get<typename Op::Params>(job.plan.look.operators), job.context, strip);
          }
        });
      }
      strip.end();
    }
  }
}

}  // namespace
}  // namespace limpid::HWY_NAMESPACE

namespace limpid {

#define LIMPID_JOIN_(a, b) a##b
#define LIMPID_JOIN(a, b) LIMPID_JOIN_(a, b)
#define LIMPID_TEXT_(a) #a
#define LIMPID_TEXT(a) LIMPID_TEXT_(a)

extern const FusedTarget LIMPID_JOIN(kFused_, LIMPID_LANES_TARGET);
const FusedTarget LIMPID_JOIN(kFused_, LIMPID_LANES_TARGET) = {
    LIMPID_TEXT(LIMPID_LANES_TARGET), HWY_NAMESPACE::kLanes, HWY_NAMESPACE::run_tile};

}  // namespace limpid

#include "limpid/run/reference.h"

#include <cmath>
#include <vector>

#include "complete/completer.h"
#include "op/pass.h"
#include "op/pixel_start.h"
#include "op/plain_texture.h"
#include "ops/kernels.h"
#include "plan/pass_of.h"
#include "run/aov_of.h"
#include "run/checks.h"
#include "run/put_edges.h"
#include "run/show_planes.h"

namespace limpid {
namespace {

/// One row of the picture in double. The samplers are as plain as can be: they are what the fast
/// ones are judged by.
class ReferenceStrip {
 public:
  using Number = double;

  ReferenceStrip(const Frame& frame, const Rect& work)
      : frame_(frame), display_(frame.display), x0_(work.x0), pixels_(work.width()) {}

  void set_row(int y) { y_ = y; }
  std::vector<Pixel<double>>& pixels() { return pixels_; }

  template <class Fn>
  void each(Fn&& fn) {
    for (Pixel<double>& p : pixels_) fn(p);
  }

  template <class Into>
  void own(PlaneId plane, Into&& into) {
    for_all([&](Pixel<double>& p, int x) { into(p, texel(plane, x, y_)); });
  }

  template <class Into>
  void own3(PlaneId first, Into&& into) {
    for_all([&](Pixel<double>& p, int x) {
      into(p, Vec3<double>{texel(first, x, y_), texel(plane_after(first, 1), x, y_),
                           texel(plane_after(first, 2), x, y_)});
    });
  }

  template <class Into>
  void around3(PlaneId first, Into&& into) {
    for_all([&](Pixel<double>& p, int x) {
      Around<double> values;
      for (int k = 0; k < 9; ++k) {
        const int column = x + k % 3 - 1, row = y_ + k / 3 - 1;
        values.at[k] = {texel(first, column, row), texel(plane_after(first, 1), column, row),
                        texel(plane_after(first, 2), column, row)};
      }
      into(p, values);
    });
  }

  template <class Where, class Into>
  void nearest(PlaneId plane, Where&& where, Into&& into) {
    for_all([&](Pixel<double>& p, int x) {
      const Vec2<double> at = position(where(p), x);
      into(p, texel(plane, clamped_floor(at.x + 0.5), clamped_floor(at.y + 0.5)));
    });
  }

  template <class Where, class Into>
  void bilinear(PlaneId plane, Where&& where, Into&& into) {
    for_all([&](Pixel<double>& p, int x) { into(p, bilinear_at(plane, position(where(p), x))); });
  }

  template <class Where, class Into>
  void bilinear_rgb(PlaneId first, Where&& where, Into&& into) {
    for_all([&](Pixel<double>& p, int x) {
      const Vec2<double> at = position(where(p), x);
      into(p, Rgb<double>{bilinear_at(first, at), bilinear_at(plane_after(first, 1), at),
                          bilinear_at(plane_after(first, 2), at)});
    });
  }

  template <class Where, class Into>
  void tiled_rgb(const Texture& texture, Where&& where, Into&& into) {
    for (Pixel<double>& p : pixels_) {
      into(p, tiled_rgb_at(texture, where(p)));
    }
  }

  template <class Width, class Where, class Into>
  void tiled_rgb(const Texture& texture, Width&& width, Where&& where, Into&& into) {
    for (Pixel<double>& p : pixels_) into(p, tiled_rgb_at(texture, where(p), width(p)));
  }

  template <class Wanted, class Where, class Into>
  void tiled_rgb_if(const Texture& texture, Wanted&& wanted, Where&& where, Into&& into) {
    for (Pixel<double>& p : pixels_) {
      if (wanted(p)) into(p, tiled_rgb_at(texture, where(p)));
    }
  }

  template <class Wanted, class Width, class Where, class Into>
  void tiled_slopes_if(const SlopeLevels& levels, Wanted&& wanted, Width&& width, Where&& where,
                       Into&& into) {
    for (Pixel<double>& p : pixels_) {
      if (wanted(p)) into(p, tiled_slopes_at(levels, where(p), width(p)));
    }
  }

  /// Four texels around a place.
  struct Quad {
    int x, y;
    double u, v;
    double weight(int k) const { return (k & 1 ? u : 1 - u) * (k & 2 ? v : 1 - v); }
  };

  /// What a probe may look up for the pixel x of this row.
  struct Tap {
    const ReferenceStrip& strip;
    int x;

    double nearest(PlaneId plane, Vec2<double> shift) const {
      const Vec2<double> at = strip.position(shift, x);
      return strip.texel(plane, clamped_floor(at.x + 0.5), clamped_floor(at.y + 0.5));
    }
    Quad quad(Vec2<double> shift) const {
      const Vec2<double> at = strip.position(shift, x);
      return {clamped_floor(at.x), clamped_floor(at.y), at.x - std::floor(at.x),
              at.y - std::floor(at.y)};
    }
    Four<double> read(PlaneId plane, const Quad& q) const {
      return {strip.texel(plane, q.x, q.y), strip.texel(plane, q.x + 1, q.y),
              strip.texel(plane, q.x, q.y + 1), strip.texel(plane, q.x + 1, q.y + 1)};
    }
    Vec2<double> place(PlaneId plane, const Quad& q, int k) const {
      const Rect& w = strip.frame_.plane(plane).window;
      const int column = std::clamp(q.x + (k & 1), w.x0, w.x1 - 1);
      const int row = std::clamp(q.y + (k >> 1), w.y0, w.y1 - 1);
      return {double(column - x) / strip.display_.width(),
              double(row - strip.y_) / strip.display_.height()};
    }
    /// The judge looks at each step.
    static SeenHeights heights(PlaneId, bool, Vec2<double>, Vec2<double>) { return {}; }
    static SeenRange range(PlaneId, bool, Vec2<double>, Vec2<double>) { return {}; }
    static bool wet() { return true; }
    Rgb<double> lat_long_rgb(const Texture& map, Vec2<double> at) const {
      return lat_long_rgb_at(map, at);
    }
    double grid(const View<const float>& table, Vec2<double> at) const {
      return grid_at(table, at);
    }
  };

  template <class Fn>
  void probe(Fn&& fn) {
    for_all([&](Pixel<double>& p, int x) { fn(p, Tap{*this, x}); });
  }

 private:
  template <class Fn>
  void for_all(Fn&& fn) {
    for (std::size_t i = 0; i < pixels_.size(); ++i) fn(pixels_[i], x0_ + static_cast<int>(i));
  }

  /// Texel coordinates (centres at integers) of a shift from the pixel x of this row.
  Vec2<double> position(Vec2<double> shift, int x) const {
    return {x + shift.x * display_.width(), y_ + shift.y * display_.height()};
  }

  static int clamped_floor(double v) {
    return static_cast<int>(std::floor(max(min(v, 1e9), -1e9)));
  }

  double texel(PlaneId plane, int x, int y) const {
    const View<const float>& view = frame_.plane(plane);
    if (!view) return missing_value(plane);
    return view.at(std::clamp(x, view.window.x0, view.window.x1 - 1),
                   std::clamp(y, view.window.y0, view.window.y1 - 1));
  }

  double bilinear_at(PlaneId plane, Vec2<double> at) const {
    const int x = clamped_floor(at.x), y = clamped_floor(at.y);
    const double u = at.x - std::floor(at.x), v = at.y - std::floor(at.y);
    const double upper = lerp(texel(plane, x, y), texel(plane, x + 1, y), u);
    const double lower = lerp(texel(plane, x, y + 1), texel(plane, x + 1, y + 1), u);
    return lerp(upper, lower, v);
  }

  const Frame& frame_;
  Rect display_;
  int x0_, y_ = 0;
  std::vector<Pixel<double>> pixels_;
};

void begin_row(const Pass& pass, const Frame& frame, const Rect& work, int y,
               std::vector<Pixel<double>>& pixels, std::vector<char>& wet) {
  const RowRays<double> rays(pass, y - pass.corner.y + 0.5);
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  for (int x = work.x0; x < work.x1; ++x) {
    const std::size_t i = static_cast<std::size_t>(x - work.x0);
    const double pixel_x = x - pass.corner.x + 0.5;
    const double dry = frame.plane(PlaneId::kDepth).at(x, y);
    const double water = surface ? surface.at(x, y) : rays.calm_depth(pixel_x);
    const Rgb<double> color{frame.plane(PlaneId::kColorR).at(x, y),
                            frame.plane(PlaneId::kColorG).at(x, y),
                            frame.plane(PlaneId::kColorB).at(x, y)};
    const PixelStart<double> start(pass, rays, pixel_x, water, dry, true);
    wet[i] = start.wet;
    begin_pixel(pass, rays, pixel_x, start.side, start.surface_depth, start.dry_depth, pixels[i]);
    begin_state(kWholeState, pass, color, pixels[i]);
  }
}

void write_wet(const Pixel<double>& p, int x, int y, const Target& target) {
  const Rgb<double> beauty = p.beauty();
  target.color[0].at(x, y) = static_cast<float>(beauty.r);
  target.color[1].at(x, y) = static_cast<float>(beauty.g);
  target.color[2].at(x, y) = static_cast<float>(beauty.b);
  if (target.alpha) target.alpha.at(x, y) = 1;
  for (int a = 0; a < kAovCount; ++a) {
    const Vec3<double> value = aov_of(p, static_cast<Aov>(a));
    const auto& views = target.aovs[a];
    if (views[0]) views[0].at(x, y) = static_cast<float>(value.x);
    if (views[1]) views[1].at(x, y) = static_cast<float>(value.y);
    if (views[2]) views[2].at(x, y) = static_cast<float>(value.z);
  }
}

void write_dry(const Frame& frame, const Pixel<double>& p, int x, int y, const Target& target) {
  const auto color = [&](int i) { return frame.plane(plane_after(PlaneId::kColorR, i)).at(x, y); };
  for (int i = 0; i < 3; ++i) target.color[i].at(x, y) = color(i);
  const View<const float>& alpha = frame.plane(PlaneId::kColorA);
  if (target.alpha) target.alpha.at(x, y) = alpha ? alpha.at(x, y) : 1;
  for (int a = 0; a < kAovCount; ++a) {
    const Vec3<double> value =
        dry_aov_of(static_cast<Aov>(a), Rgb<double>{color(0), color(1), color(2)}, p.uv,
                   double(aovs()[a].dry));
    const auto& views = target.aovs[a];
    if (views[0]) views[0].at(x, y) = static_cast<float>(value.x);
    if (views[1]) views[1].at(x, y) = static_cast<float>(value.y);
    if (views[2]) views[2].at(x, y) = static_cast<float>(value.z);
  }
}

}  // namespace

void run_reference(const Plan& plan, const Frame& plate, const Scene& scene, const Target& target) {
  check_run(plan, plate, scene, target);
  const std::unique_ptr<Executor> serial = make_executor(1);
  Completer completer;
  const Frame frame = completer.complete(plan, plate, pass_of(plan, scene, plate), *serial);
  Pass pass = pass_of(plan, scene, frame);
  if (!plan.reads_environment) pass.environment = {};  // nobody has checked it
  const Rect work = frame.work();
  ReferenceStrip strip(frame, work);
  std::vector<char> wet(work.width());
  for (int y = work.y0; y < work.y1; ++y) {
    strip.set_row(y);
    begin_row(pass, frame, work, y, strip.pixels(), wet);
    Kernels::for_each([&]<class Op, int I>() {
      if (plan.keeps(I)) Op::apply(plan.look.of<Op>(), pass, strip);
    });
    for (int x = work.x0; x < work.x1; ++x) {
      const std::size_t i = static_cast<std::size_t>(x - work.x0);
      if (wet[i]) {
        write_wet(strip.pixels()[i], x, y, target);
      } else {
        write_dry(frame, strip.pixels()[i], x, y, target);
      }
    }
  }
  put_edges(frame, target, *serial);
  show_planes(plan, frame, target, *serial);
}

}  // namespace limpid

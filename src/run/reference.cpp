#include "limpid/run/reference.h"

#include <cmath>
#include <vector>

#include "complete/completer.h"
#include "op/pass.h"
#include "op/pixel_start.h"
#include "op/plain_textures.h"
#include "ops/kernels.h"
#include "plan/pass_of.h"
#include "run/aov_of.h"
#include "run/checks.h"
#include "run/plain_taps.h"
#include "run/put_edges.h"
#include "run/show_planes.h"

namespace limpid {
namespace {

/// One row of the picture in double. The samplers are as simple as possible: the standard for the
/// fast samplers.
class ReferenceStrip : public PlainTextures<ReferenceStrip> {
 public:
  using Number = double;

  ReferenceStrip(const Frame& frame, const Rect& work)
      : frame_(frame), x0_(work.x0), pixels_(work.width()) {}

  void set_row(int y) { y_ = y; }
  std::vector<Pixel<double>>& pixels() { return pixels_; }

  template <class Fn>
  void each(Fn&& fn) {
    for (Pixel<double>& p : pixels_) fn(p);
  }

  template <class Into>
  void own(PlaneId plane, Into&& into) {
    probe([&](Pixel<double>& p, const PlainTaps& tap) { into(p, tap.own(plane)); });
  }

  template <class Into>
  void own3(PlaneId first, Into&& into) {
    probe([&](Pixel<double>& p, const PlainTaps& tap) {
      into(p, Vec3<double>{tap.own(first), tap.own(plane_after(first, 1)),
                           tap.own(plane_after(first, 2))});
    });
  }

  template <class Into>
  void around3(PlaneId first, Into&& into) {
    probe([&](Pixel<double>& p, const PlainTaps& tap) {
      Around<double> values;
      for (int k = 0; k < 9; ++k) {
        values.at[k] = {tap.beside(first, k), tap.beside(plane_after(first, 1), k),
                        tap.beside(plane_after(first, 2), k)};
      }
      into(p, values);
    });
  }

  template <class Where, class Into>
  void nearest(PlaneId plane, Where&& where, Into&& into) {
    probe([&](Pixel<double>& p, const PlainTaps& tap) { into(p, tap.nearest(plane, where(p))); });
  }

  template <class Where, class Into>
  void bilinear(PlaneId plane, Where&& where, Into&& into) {
    probe([&](Pixel<double>& p, const PlainTaps& tap) { into(p, tap.bilinear(plane, where(p))); });
  }

  template <class Where, class Into>
  void bilinear_rgb(PlaneId first, Where&& where, Into&& into) {
    probe([&](Pixel<double>& p, const PlainTaps& tap) {
      const Vec2<double> shift = where(p);
      into(p, Rgb<double>{tap.bilinear(first, shift), tap.bilinear(plane_after(first, 1), shift),
                          tap.bilinear(plane_after(first, 2), shift)});
    });
  }

  template <class Fn>
  void probe(Fn&& fn) {
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      fn(pixels_[i], PlainTaps(frame_, x0_ + static_cast<int>(i), y_));
    }
  }

 private:
  const Frame& frame_;
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
  pass.plate_waves = completer.plate_waves();
  if (!plan.reads_environment) pass.environment = {};  // not checked
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

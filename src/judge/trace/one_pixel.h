#pragma once
#include <cmath>

#include "limpid/core/frame.h"

#include "op/height_bound.h"
#include "op/pixel.h"
#include "op/plain_textures.h"

namespace limpid::trace {

/// A strip of one pixel (op/operator.h) without planes, for operators whose only lookups are tiling
/// textures and the sun's shadow on the surface at the pixel itself.
struct OnePixel : PlainTextures<OnePixel> {
  using Number = double;

  explicit OnePixel(Pixel<double>& p) : pixel(p) {}

  Pixel<double>& pixel;
  double shadow = 1;

  template <class Fn>
  void each(Fn&& fn) {
    fn(pixel);
  }
  template <class Into>
  void own(PlaneId, Into&& into) {
    into(pixel, shadow);
  }
  /// Surface normals: calm, because a mesh's normals are not looked up.
  template <class Into>
  void own3(PlaneId, Into&& into) {
    into(pixel, pixel.normal);
  }
  template <class Into>
  void around3(PlaneId, Into&& into) {
    Around<double> same;
    for (Vec3<double>& value : same.at) value = pixel.normal;
    into(pixel, same);
  }
  /// A picture without any surface.
  struct Tap {
    static double nearest(PlaneId, Vec2<double>) { return HUGE_VAL; }
    static SeenRange range(PlaneId, bool, Vec2<double>, Vec2<double>) {
      return {HUGE_VALF, -HUGE_VALF};
    }
    static bool wet() { return true; }
  };
  template <class Fn>
  void probe(Fn&& fn) {
    fn(pixel, Tap{});
  }
};

}  // namespace limpid::trace

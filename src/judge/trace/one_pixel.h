#pragma once
#include <cmath>
#include <utility>

#include "limpid/core/frame.h"

#include "op/height_bound.h"
#include "op/pixel.h"
#include "op/plain_texture.h"

namespace limpid::trace {

/// A strip of one pixel (op/operator.h) without planes, for operators whose only lookups are tiling
/// textures and the sun's shadow on the surface at the pixel itself.
struct OnePixel {
  using Number = double;

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
  template <class Where, class Into>
  void tiled_rgb(const Texture& texture, Where&& where, Into&& into) {
    into(pixel, tiled_rgb_at(texture, where(std::as_const(pixel))));
  }
  template <class Width, class Where, class Into>
  void tiled_rgb(const Texture& texture, Width&& width, Where&& where, Into&& into) {
    into(pixel, tiled_rgb_at(texture, where(std::as_const(pixel)), width(pixel)));
  }
  template <class Wanted, class Where, class Into>
  void tiled_rgb_if(const Texture& texture, Wanted&& wanted, Where&& where, Into&& into) {
    if (wanted(pixel)) tiled_rgb(texture, where, into);
  }
  template <class Wanted, class Width, class Where, class Into>
  void tiled_slopes_if(const SlopeLevels& levels, Wanted&& wanted, Width&& width, Where&& where,
                       Into&& into) {
    if (wanted(pixel)) into(pixel, tiled_slopes_at(levels, where(pixel), width(pixel)));
  }
};

}  // namespace limpid::trace

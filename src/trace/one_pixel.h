#pragma once
#include "limpid/core/frame.h"
#include "limpid/op/pixel.h"

#include "op/plain_texture.h"

namespace limpid::trace {

/// A strip of one pixel (op/operator.h) without pictures, for operators that look up nothing but
/// tiling textures and, as their own, the sun's shadow on the surface.
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
  /// Surface normals: calm ones, for those of a mesh are not looked up.
  template <class Into>
  void own3(PlaneId, Into&& into) {
    into(pixel, pixel.normal);
  }
  template <class Where, class Into>
  void tiled_rgb(const Texture& texture, Where&& where, Into&& into) {
    into(pixel, tiled_rgb_at(texture, where(std::as_const(pixel))));
  }
};

}  // namespace limpid::trace

#pragma once
#include <utility>

#include "op/pixel.h"
#include "op/plain_texture.h"

namespace limpid {

/// The lookups in tiling textures (op/operator.h) of a strip of pixels in double, by the strip's
/// own `each`. A base of the class `Strip`.
template <class Strip>
class PlainTextures {
 public:
  template <class Where, class Into>
  void tiled_rgb(const Texture& texture, Where&& where, Into&& into) {
    each([&](Pixel<double>& p) { into(p, tiled_rgb_at(texture, where(std::as_const(p)))); });
  }

  template <class Width, class Where, class Into>
  void tiled_rgb(const Texture& texture, Width&& width, Where&& where, Into&& into) {
    each([&](Pixel<double>& p) {
      into(p, tiled_rgb_at(texture, where(std::as_const(p)), width(std::as_const(p))));
    });
  }

  template <class Wanted, class Where, class Into>
  void tiled_rgb_if(const Texture& texture, Wanted&& wanted, Where&& where, Into&& into) {
    each([&](Pixel<double>& p) {
      if (wanted(p)) into(p, tiled_rgb_at(texture, where(std::as_const(p))));
    });
  }

  template <class Wanted, class Width, class Where, class Into>
  void tiled_slopes_if(const SlopeLevels& levels, Wanted&& wanted, Width&& width, Where&& where,
                       Into&& into) {
    each([&](Pixel<double>& p) {
      if (wanted(p)) into(p, tiled_slopes_at(levels, where(p), width(p)));
    });
  }

 private:
  template <class Fn>
  void each(Fn&& fn) {
    static_cast<Strip&>(*this).each(std::forward<Fn>(fn));
  }
};

}  // namespace limpid

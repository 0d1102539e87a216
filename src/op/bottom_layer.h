#pragma once
#include "op/pass.h"
#include "op/pixel.h"
#include "op/screen_ray.h"

/// @file
/// The bottom where nobody rendered it: behind what stands in the water, or before it.

namespace limpid {

/// What the bottom of a frame looks like, and how deep it lies, as if nothing stood before it. Made
/// by complete/ for frames in which something does; coarse, for what is known is looked up in the
/// planes.
struct BottomLayer {
  /// What reaches down to this share of the depth around it is of the bottom.
  static constexpr double kOfBottom = 0.75;

  Texture colors;
  /// Red: depth of the bottom below the calm surface, in scene units. Green: more than half where
  /// there is no bottom, for around there the picture shows none. Blue: 1 / thickness of what
  /// stands before the bottom, 0 where nothing does.
  Texture shape;
  glm::dvec2 scale, offset;  ///< from uv of the picture to that of the textures
  double most_drop;          ///< the largest depth in `shape`
};

/// Of a pixel, or of a vector of pixels.
template <class F, class Tap>
class BottomLayerTaps {
 public:
  BottomLayerTaps(const BottomLayer& layer, const Pixel<F>& pixel, const Tap& tap)
      : layer_(layer), p_(pixel), tap_(tap) {}

  struct Shape {
    F drop;      ///< below the calm surface
    F thinness;  ///< 1 / thickness
  };
  Shape shape(Vec2<F> shift) const {
    const Rgb<F> there = tap_.lat_long_rgb(layer_.shape, place(shift));
    return {there.r, there.b};
  }
  /// Shape::drop alone, which takes a third of the lookups.
  F bottom(Vec2<F> shift) const { return tap_.lat_long_rgb(layer_.shape, place(shift)).r; }
  /// Whether the bottom has ended before `shift`.
  auto is_bottomless(Vec2<F> shift) const {
    return tap_.lat_long_rgb(layer_.shape, place(shift)).g > F(0.5);
  }
  /// Whether what is seen at `shift`, `drop` below the calm surface, is of the bottom.
  auto is_bottom(Vec2<F> shift, F drop) const {
    return drop >= F(BottomLayer::kOfBottom) * bottom(shift);
  }
  /// Whether bottom is seen on the screen between the pixel and `shift`: what stands at the one is
  /// no part of what stands at the other, as the sides of a hull are of its inside. `depth` is the
  /// plane.
  auto is_apart(const Pass& c, PlaneId depth, Vec2<F> shift) const {
    constexpr int kPlaces = 8;
    F apart(0);
    steps<F>(1, kPlaces, [&](auto i) {
      const Vec2<F> at = Loop<F>::ratio(i, kPlaces) * shift;
      const F drop = F(0) - height_at(c, p_, at, tap_.nearest(depth, at));
      apart = select(is_bottom(at, drop), F(1), apart);
      return apart < F(0.5);
    });
    return apart > F(0.5);
  }
  Rgb<F> color(Vec2<F> shift) const { return tap_.lat_long_rgb(layer_.colors, place(shift)); }

 private:
  /// Between the centres of the outermost texels, for the lookup goes round in x.
  Vec2<F> place(Vec2<F> shift) const {
    const auto& window = layer_.shape.channels[0].window;
    const auto kept = [](double size, F at, int axis) {
      return min(max(at, given<F>(0.5 / size, "bottom_layer.first", axis)),
                 given<F>(1 - 0.5 / size, "bottom_layer.last", axis));
    };
    const F x = given<F>(layer_.scale.x) * (p_.uv.x + shift.x) + given<F>(layer_.offset.x);
    const F y = given<F>(layer_.scale.y) * (p_.uv.y + shift.y) + given<F>(layer_.offset.y);
    return {kept(window.width(), x, 0), kept(window.height(), y, 1)};
  }

  const BottomLayer& layer_;
  const Pixel<F>& p_;
  const Tap& tap_;
};

}  // namespace limpid

#pragma once
#include "op/pass.h"
#include "op/pixel.h"
#include "op/screen_ray.h"
#include "op/seen_planes.h"

/// @file
/// The bottom where no buffer shows it, because an object in the water hides it.

namespace limpid {

/// Color and depth of the bottom of a frame, as if no object stood in front of it. Made by
/// complete/ for frames in which objects stand in the water. Coarse: where the bottom is visible,
/// the planes themselves are looked up.
struct BottomLayer {
  /// A surface at this share of the depth around it, or deeper, belongs to the bottom.
  static constexpr double kOfBottom = 0.75;
  /// Thickness of an object behind its visible side, as a share of its width: a ray that goes
  /// behind it passes the outline, where a round object is thinnest.
  static constexpr double kThickness = 1.0 / 3;

  Texture colors;
  /// Red: depth of the bottom below the calm surface, in scene units. Green: more than half where
  /// there is no bottom, because the picture shows none around. Blue: 1 / thickness of the object
  /// in front of the bottom, 0 without an object.
  Texture shape;
  glm::dvec2 scale, offset;  ///< from the picture's uv to the textures' uv
  double most_drop;          ///< the largest depth in `shape`
  bool lit;                  ///< whether `colors` are those of sunlit bottom alone
};

/// The bottom layer as one pixel, or one vector of pixels, looks it up.
template <class F, class Tap>
class BottomLayerTaps {
 public:
  BottomLayerTaps(const BottomLayer& layer, const Pixel<F>& pixel, const Tap& tap)
      : layer_(layer), p_(pixel), tap_(tap) {}

  struct Shape {
    F drop;      ///< depth below the calm surface
    F thinness;  ///< 1 / thickness of the object
  };
  Shape shape(Vec2<F> shift) const {
    const Rgb<F> there = tap_.lat_long_rgb(layer_.shape, place(shift));
    return {there.r, there.b};
  }
  /// Shape::drop alone, for a third of the lookups.
  F bottom(Vec2<F> shift) const { return tap_.lat_long_rgb(layer_.shape, place(shift)).r; }
  /// Whether there is no bottom at `shift`.
  auto is_bottomless(Vec2<F> shift) const {
    return tap_.lat_long_rgb(layer_.shape, place(shift)).g > F(0.5);
  }
  /// Whether the surface that is visible at `shift`, `drop` below the calm surface, is the bottom.
  auto is_bottom(Vec2<F> shift, F drop) const {
    return drop >= F(BottomLayer::kOfBottom) * bottom(shift);
  }
  /// Whether bottom is visible on the screen between the pixel and `shift`: then the two belong to
  /// different objects. The sides of a hull and its inside do not.
  auto is_apart(const Pass& c, const SeenPlanes& planes, Vec2<F> shift) const {
    constexpr int kPlaces = 8;
    F apart(0);
    steps<F>(1, kPlaces, [&](auto i) {
      const Vec2<F> at = Loop<F>::ratio(i, kPlaces) * shift;
      const F depth = tap_.nearest(planes.depth, at);
      const F drop = F(0) - height_at(c, p_, at, depth);
      // The layer below the water is empty where an object rises out of the water.
      const auto shown = planes.below ? depth < F(1e30) : F(0) < F(1);
      apart = select(shown && is_bottom(at, drop), F(1), apart);
      return apart < F(0.5);
    });
    return apart > F(0.5);
  }
  /// Whether the surface that the pixel shows lies farther behind the object at `shift` than that
  /// object is wide, on its narrower side: then the two are different objects, and the bottom goes
  /// on between them.
  auto is_far_behind(const Pass& c, const SeenPlanes& planes, Vec2<F> shift) const {
    const F depth = tap_.nearest(planes.depth, shift), gap = min(p_.dry_depth, F(1e30)) - depth;
    const auto is_object = !is_bottom(shift, F(0) - height_at(c, p_, shift, depth));
    return is_object && F(BottomLayer::kThickness) * gap * shape(shift).thinness > F(1);
  }
  Rgb<F> color(Vec2<F> shift) const { return tap_.lat_long_rgb(layer_.colors, place(shift)); }

 private:
  /// Kept between the centres of the outermost texels, because the lookup wraps around in x.
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

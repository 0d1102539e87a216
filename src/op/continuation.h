#pragma once
#include "op/bottom_search.h"
#include "op/pixel.h"
#include "op/round_edge.h"

/// @file
/// The bottom beyond the edge of the picture, for rays that leave the picture under water.

namespace limpid {

/// The bottom beyond the picture: a plane and its colors. Made by complete/ for frames in which a
/// ray leaves the picture.
struct Continuation {
  glm::dvec3 normal;  ///< of the plane, unit, towards the water
  double offset;      ///< dot(normal, p) of its points p, which are relative to the eye
  /// Unit, on the plane: the direction in which the bottom changes least, as along the tiles of a
  /// pool. Colors at the edge of the picture continue in this direction.
  glm::dvec3 along;
  double least_drop;  ///< below the calm surface, in scene units: the highest end of a ray
  /// Surfaces at the edge within this distance of the bottom's height there belong to the bottom.
  double lift;
  /// The edge's color has the weight e^(-fade pixels), the depth of its bottom e^(-settle pixels),
  /// by the distance of the ray's end from the edge in pixels.
  double fade, settle;
  /// Of a bottom without lines the edge's color is the mean of texels from the edge inwards, so
  /// that grains do not become columns: over this multiple of the distance from the edge to the
  /// ray's end. 0 of a bottom with lines.
  double inwards;
  /// The remaining weight: colors near the edge, in the upper of two rows around the picture
  /// (op/round_edge.h). Below them, in red, the height of the bottom near that edge over the plane.
  Texture colors;
  static constexpr double kColorRow = 0.25, kHeightRow = 0.75;  ///< as places in `colors`
};

/// The ray of one pixel, or of one vector of pixels, beyond the picture. `falls` as in a
/// BottomSearch, per unit along `direction`.
template <class F, class Tap>
class OffFrameRay {
 public:
  struct Seen {
    F distance;     ///< distance along the ray
    Vec2<F> shift;  ///< shift of the place at the edge that stands for the ray's end
    Rgb<F> color;
  };

  OffFrameRay(const Pass& pass, const SeenPlanes& seen, const Pixel<F>& pixel, const Tap& taps,
              const ScreenRay<F>& distance, Vec3<F> direction, F falls)
      : c_(pass),
        on_(*pass.continuation),
        planes_(seen),
        p_(pixel),
        tap_(taps),
        ray_(distance),
        direction_(direction),
        fall_(falls) {}

  /// `guess`: the distance to the ray's end by the bottom visible in the picture.
  Seen look(F guess) const {
    const Vec2<F> toward = ray_.shift_at(guess);
    const Vec2<F> edge = min(reach_in(planes_.bounds, p_.uv, toward), F(1)) * toward;
    const F settled = tap_.lat_long_rgb(on_.colors, {round_edge(edge), F(on_.kHeightRow)}).r;
    const F near = distance_to_plane(settled, guess);
    const F share = exp((F(0) - given<F>(on_.settle)) * pixels_beyond(ray_.shift_at(near)));
    const F distance = distance_to_plane(settled + share * step_at_edge(edge, settled), guess);
    const Vec2<F> end = ray_.shift_at(distance), at = along_to_edge(end);
    const F gone = length_on_screen(at - end);
    const Texels texels = texels_along(at, given<F>(on_.inwards) * (at - end));
    const F kept = texels.share * exp((F(0) - given<F>(on_.fade)) * gone);
    const Rgb<F> far = tap_.lat_long_rgb(on_.colors, {round_edge(at), F(on_.kColorRow)});
    return {distance, at, far + kept * (texels.color - far)};
  }

 private:
  /// Length in pixels, at most a million.
  F length_on_screen(Vec2<F> shift) const {
    const F x = given<F>(c_.size.x) * shift.x, y = given<F>(c_.size.y) * shift.y;
    return min(sqrt(x * x + y * y), F(1e6));
  }
  Vec2<F> kept_in(Vec2<F> shift) const {
    const Bounds& b = planes_.bounds;
    return {min(max(shift.x, given<F>(b.low.x) - p_.uv.x), given<F>(b.high.x) - p_.uv.x),
            min(max(shift.y, given<F>(b.low.y) - p_.uv.y), given<F>(b.high.y) - p_.uv.y)};
  }
  F pixels_beyond(Vec2<F> shift) const { return length_on_screen(shift - kept_in(shift)); }

  /// Distance to the plane raised by `lift`; never above Continuation::least_drop, and `guess`
  /// where the ray is nearly parallel to the plane.
  F distance_to_plane(F lift, F guess) const {
    const Vec3<F> normal = vec3_of<F>(on_.normal);
    const F nears = F(0) - dot(normal, direction_);
    const F over = dot(normal, p_.surface_point) - given<F>(on_.offset) - lift;
    const F distance = select(nears > F(0.02), over / max(nears, F(0.02)), guess);
    return max(distance, given<F>(on_.least_drop) / fall_);
  }

  /// How much higher than `settled` over the plane the bottom is that is seen at the edge; 0 where
  /// the picture shows no bottom there.
  F step_at_edge(Vec2<F> edge, F settled) const {
    const F depth = tap_.nearest(planes_.depth, edge);
    const Vec3<F> there = p_.surface_point + offset_to(c_, p_, edge, depth);
    const F step = dot(vec3_of<F>(on_.normal), there) - given<F>(on_.offset) - settled;
    const auto bottom = depth < F(1e30) && abs(step) < given<F>(on_.lift);
    return select(bottom, step, F(0));
  }

  /// Where the line along the bottom through the ray's end enters the picture.
  Vec2<F> along_to_edge(Vec2<F> end) const {
    const F step = given<F>(c_.w_depth * dot_of(c_.forward, on_.along), "continuation.w_along");
    const Vec2<F> across{
        given<F>(dot_of(c_.to_u, on_.along), "continuation.u_along") - (p_.uv.x + end.x) * step,
        given<F>(dot_of(c_.to_v, on_.along), "continuation.v_along") - (p_.uv.y + end.y) * step};
    const Vec2<F> lacks = kept_in(end) - end;
    const auto times = [](F lack, F pace) {
      return select(abs(pace) > F(1e-12), lack / select(abs(pace) > F(1e-12), pace, F(1)), F(0));
    };
    const F x = times(lacks.x, across.x), y = times(lacks.y, across.y);
    const auto same_sign = x * y >= F(0);
    const F main =
        select(abs(lacks.x) * given<F>(c_.size.x) > abs(lacks.y) * given<F>(c_.size.y), x, y);
    const F both = select(abs(x) > abs(y), x, y);
    const F by = select(same_sign, both, main);
    // A line nearly parallel to the edge would start at an arbitrary place.
    const F far = max(abs(by * across.x), abs(by * across.y));
    const F near = saturate(F(2) - far) * select(by * step < F(0.98), F(1), F(0));
    return kept_in(end + select(near > F(0), near * by, F(0)) * across);
  }

  struct Texels {
    Rgb<F> color;
    F share;  ///< share of the colors that show the bottom
  };
  /// The mean of four places from the edge to Continuation::inwards.
  Texels texels_along(Vec2<F> edge, Vec2<F> inwards) const {
    constexpr int kPlaces = 4;
    Texels sum{{F(0), F(0), F(0)}, F(0)};
    each<F>(kPlaces, [&](auto i) {
      const F way = F(kPlaces / (kPlaces - 1.0)) * Loop<F>::ratio(i, kPlaces);
      const Texels at = texels_at(kept_in(edge + way * inwards));
      sum.color = sum.color + at.share * at.color;
      sum.share = sum.share + at.share;
    });
    return {(F(1) / max(sum.share, F(1e-6))) * sum.color, F(1.0 / kPlaces) * sum.share};
  }
  Texels texels_at(Vec2<F> shift) const {
    const auto quad = tap_.quad(shift);
    const Four<F> depths = tap_.read(planes_.depth, quad);
    const Four<F> red = tap_.read(planes_.color, quad);
    const Four<F> green = tap_.read(plane_after(planes_.color, 1), quad);
    const Four<F> blue = tap_.read(plane_after(planes_.color, 2), quad);
    Texels sum{{F(0), F(0), F(0)}, F(0)};
    for (int k = 0; k < 4; ++k) {
      const F height = height_at(c_, p_, tap_.place(planes_.depth, quad, k), depths[k]);
      const auto wet = height < F(0) && depths[k] < F(1e30);
      const F weight = select(wet, quad.weight(k), F(0));
      sum.color = sum.color + weight * Rgb<F>{red[k], green[k], blue[k]};
      sum.share = sum.share + weight;
    }
    sum.color = (F(1) / max(sum.share, F(1e-6))) * sum.color;
    return sum;
  }

  /// The coordinate of a place in Continuation::colors.
  F round_edge(Vec2<F> shift) const {
    return limpid::round_edge(planes_.bounds, p_.uv + shift, "continuation.size");
  }

  static double dot_of(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }

  const Pass& c_;
  const Continuation& on_;
  const SeenPlanes& planes_;
  const Pixel<F>& p_;
  const Tap& tap_;
  const ScreenRay<F>& ray_;
  Vec3<F> direction_;
  F fall_;
};

}  // namespace limpid

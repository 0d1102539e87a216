#pragma once
#include "limpid/op/operator.h"
#include "limpid/optics/fog.h"

namespace limpid {

/// Dims and tints what lies under the surface by the length of the way through the water.
///
/// The way, by `distance`: `eye` is the difference of eye depths between the hit and this pixel's
/// surface, `ray` the same along the pixel's straight ray. Never below 0; +inf where the ray ends
/// in the sky.
///
/// `linear` ("Realistic Water"): f = 1 - sat(density d - offset), c = lerp(color, u, f), out =
/// lerp(u, c, alpha). So transmitted keeps the share 1 - alpha (1 - f), and alpha (1 - f) color
/// comes in.
struct DepthFog {
  enum class Model { kLinear };
  enum class Distance { kEye, kRay };
  struct Params {
    Model model = Model::kLinear;
    Distance distance = Distance::kEye;
    double density = 0.15;
    double offset = 0;
    Rgb<double> color{0.02, 0.10, 0.12};
    double alpha = 0.9;
  };

  static constexpr std::string_view kName = "depth_fog";
  static constexpr std::string_view kAbout = "Dims and tints by the way through the water.";
  static constexpr StateSet kUses{StatePart::kPosition, StatePart::kTransmitted};
  static constexpr StateSet kMakes{StatePart::kPath, StatePart::kTransmitted,
                                   StatePart::kInScatter};
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params&) { return {}; }
  static Needs needs(const Params&) { return {}; }
  static double reach(const Params&) { return 0; }
  /// density 0 leaves every pixel as it is, unless a negative offset lifts the fog at distance 0.
  static bool neutral(const Params& p, StateSet) {
    return p.alpha == 0 || (p.density == 0 && p.offset >= 0);
  }

  template <class Strip>
  static void apply(const Params& params, const Context&, Strip& strip) {
    using F = typename Strip::Number;
    const F density(params.density), offset(params.offset), alpha(params.alpha);
    const Rgb<F> color{F(params.color.r), F(params.color.g), F(params.color.b)};
    const bool along_ray = params.distance == Distance::kRay;
    strip.each([&](Pixel<F>& p) {
      const F depth_difference = max(p.hit_depth - p.surface_depth, F(0));
      p.path = along_ray ? p.ray_length * depth_difference : depth_difference;
      const F veil = alpha * (F(1) - linear_fog(p.path, density, offset));
      p.transmitted = (F(1) - veil) * p.transmitted;
      p.in_scatter = veil * color;
    });
  }
};

}  // namespace limpid

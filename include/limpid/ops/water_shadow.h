#pragma once
#include "limpid/op/operator.h"

namespace limpid {

/// The sun's shadow on murky water.
///
/// `darken` ("Realistic Water"): all that comes from below is multiplied by 1 - strength (1 -
/// shadow(uv')), bilinear. Not physical: independent of how murky the water is and how deep, and
/// down to black as if the sky gave no light.
///
/// `scatter`: takes the sun's share of what the water sends where the sun does not reach the water:
/// in_scatter -= strength ((1 - v_near) sun_near + (1 - v_far) sun_far), never below 0. v_near is
/// the shadow on the surface at this pixel (that of what lies below it, should the frame have no
/// other), v_far that at uv'. Clear water shows no shadow of its own, the bottom's is in the dry
/// picture already.
struct WaterShadow {
  enum class Model { kDarken, kScatter };
  struct Params {
    Model model = Model::kScatter;
    double strength = 1;
  };

  static constexpr std::string_view kName = "water_shadow";
  static constexpr std::string_view kAbout = "Shadow of the sun on murky water.";
  static constexpr StateSet kUses{StatePart::kPosition, StatePart::kTransmitted,
                                  StatePart::kInScatter, StatePart::kSunScatter};
  static constexpr StateSet kMakes{StatePart::kTransmitted, StatePart::kInScatter};
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params& p) {
    return p.model == Model::kScatter ? PlaneSet{PlaneId::kShadow, PlaneId::kSurfaceShadow}
                                      : PlaneSet{PlaneId::kShadow};
  }
  static Needs needs(const Params&) { return {.planes = {PlaneId::kShadow}}; }
  static double reach(const Params&) { return 0; }  // beyond what refraction reaches
  static bool neutral(const Params& p, StateSet made) {
    return p.strength == 0 || (p.model == Model::kScatter && !made.has(StatePart::kSunScatter));
  }
  static double bound(const Params& params, const Context& c, const Ranges& ranges);
  /// How much the picture changes at most when the shadow is looked up elsewhere in reach, or as
  /// if no sunlight were scattered at the end of the way.
  static double displaced(const Params& params, const Ranges& ranges);

  template <class Strip>
  static void apply(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    const F strength(params.strength);
    const auto where = [](const Pixel<F>& p) { return p.shift; };
    if (params.model == Model::kDarken) {
      strip.bilinear(PlaneId::kShadow, where, [&](Pixel<F>& p, F shadow) {
        const F keep = F(1) - strength * (F(1) - shadow);
        p.transmitted = keep * p.transmitted;
        p.in_scatter = keep * p.in_scatter;
      });
      return;
    }
    const auto take = [&](Pixel<F>& p, F shadow, Rgb<F> lit) {
      const Rgb<F> left = p.in_scatter - strength * (F(1) - shadow) * lit;
      p.in_scatter = {max(left.r, F(0)), max(left.g, F(0)), max(left.b, F(0))};
    };
    const bool on_surface = c.planes.has(PlaneId::kSurfaceShadow);
    strip.own(on_surface ? PlaneId::kSurfaceShadow : PlaneId::kShadow,
              [&](Pixel<F>& p, F shadow) { take(p, shadow, p.sun_near); });
    strip.bilinear(PlaneId::kShadow, where,
                   [&](Pixel<F>& p, F shadow) { take(p, shadow, p.sun_far); });
  }
};

}  // namespace limpid

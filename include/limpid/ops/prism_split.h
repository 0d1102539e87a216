#pragma once
#include "limpid/op/operator.h"

namespace limpid {

/// How far each color channel departs from the common refracted path.
///
/// `axis` ("Realistic Water"): with s = strength * tilt, red is looked up at uv' + (s.x, 0), green
/// at uv' + s / 2, blue at uv' + (0, s.y). Not dispersion: the shifts follow the screen's axes, not
/// the direction of refraction, and do not grow with depth. Kept as the article has it.
struct PrismSplit {
  enum class Model { kAxis };
  struct Params {
    Model model = Model::kAxis;
    double strength = 0;
  };

  static constexpr std::string_view kName = "prism_split";
  static constexpr std::string_view kAbout = "Splits the refracted lookup by color channel.";
  static constexpr StateSet kUses{StatePart::kNormal};
  static constexpr StateSet kMakes{StatePart::kPrism};
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params&) { return {}; }
  static Needs needs(const Params&) { return {}; }
  static double reach(const Params& p) { return abs(p.strength); }  // added to refraction's
  static bool neutral(const Params& p, StateSet made) {
    return p.strength == 0 || !made.has(StatePart::kNormal);
  }

  template <class Strip>
  static void apply(const Params& params, const Context&, Strip& strip) {
    using F = typename Strip::Number;
    const F strength(params.strength);
    strip.each([&](Pixel<F>& p) {
      const Vec2<F> s = strength * p.tilt;
      p.prism_r = {s.x, F(0)};
      p.prism_g = F(0.5) * s;
      p.prism_b = {F(0), s.y};
    });
  }
};

}  // namespace limpid

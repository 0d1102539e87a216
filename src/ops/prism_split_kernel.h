#pragma once
#include "limpid/ops/prism_split.h"

#include "op/operator.h"
#include "optics/water_index.h"

namespace limpid {

template <>
struct Kernel<PrismSplit> : PrismSplit {
  static constexpr StateSet kUses{StatePart::kNormal};
  static constexpr StateSet kMakes{StatePart::kPrism};
  static PlaneSet reads(const Params&) { return {}; }
  static Needs needs(const Params&) { return {}; }
  static double reach(const Params& p) {  // added to the reach of refraction
    return p.model == Model::kAxis ? abs(p.strength) : 0;
  }
  static bool neutral(const Params& p, StateSet made) {
    if (p.model == Model::kDispersion) return p.gain == 0;
    return p.strength == 0 || !made.has(StatePart::kNormal);
  }
  static double bound(const Params& params, const Pass& c, const Ranges& ranges);
  /// How many times as far as the common lookup the channels' lookups go, where refraction offsets
  /// them by their index.
  static double stretch(const Params& params, const Pass& c);

  static double ns(const Params&, const Running&) { return 0.3; }

  template <class Strip>
  static void apply(const Params& params, const Pass&, Strip& strip) {
    using F = typename Strip::Number;
    if (params.model == Model::kDispersion) {
      const double green = water_index(kGreenWavelength);
      const F red = given<F>(params.gain * (water_index(kRedWavelength) - green),
                             "prism_split.dispersion", 0);
      const F blue = given<F>(params.gain * (water_index(kBlueWavelength) - green),
                              "prism_split.dispersion", 2);
      return strip.each([&](Pixel<F>& p) {
        p.prism_r = p.prism_g = p.prism_b = {F(0), F(0)};
        p.dispersion = {red, F(0), blue};
      });
    }
    const F strength = given<F>(params.strength);
    strip.each([&](Pixel<F>& p) {
      const Vec2<F> s = strength * p.tilt;
      p.prism_r = {s.x, F(0)};
      p.prism_g = F(0.5) * s;
      p.prism_b = {F(0), s.y};
      p.dispersion = {F(0), F(0), F(0)};
    });
  }
};

}  // namespace limpid

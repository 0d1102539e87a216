#pragma once
#include "limpid/op/operator.h"

namespace limpid {

/// The sun's shadow on murky water.
///
/// `darken` ("Realistic Water"): all that comes from below is multiplied by 1 - strength (1 -
/// shadow(uv')), bilinear. Not physical: independent of how murky the water is and how deep, and
/// down to black as if the sky gave no light.
struct WaterShadow {
  enum class Model { kDarken };
  struct Params {
    Model model = Model::kDarken;
    double strength = 0.5;
  };

  static constexpr std::string_view kName = "water_shadow";
  static constexpr std::string_view kAbout = "Shadow of the sun on murky water.";
  static constexpr StateSet kUses{StatePart::kPosition, StatePart::kTransmitted,
                                  StatePart::kInScatter};
  static constexpr StateSet kMakes{StatePart::kTransmitted, StatePart::kInScatter};
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params&) { return {PlaneId::kShadow}; }
  static Needs needs(const Params& p) { return {.planes = reads(p)}; }
  static double reach(const Params&) { return 0; }  // beyond what refraction reaches
  static bool neutral(const Params& p, StateSet) { return p.strength == 0; }

  template <class Strip>
  static void apply(const Params& params, const Context&, Strip& strip) {
    using F = typename Strip::Number;
    const F strength(params.strength);
    strip.bilinear(
        PlaneId::kShadow, [](const Pixel<F>& p) { return p.shift; },
        [&](Pixel<F>& p, F shadow) {
          const F keep = F(1) - strength * (F(1) - shadow);
          p.transmitted = keep * p.transmitted;
          p.in_scatter = keep * p.in_scatter;
        });
  }
};

}  // namespace limpid

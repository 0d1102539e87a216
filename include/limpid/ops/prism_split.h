#pragma once
#include "limpid/op/operator.h"
#include "limpid/optics/water_index.h"

namespace limpid {

/// How far each color channel departs from the common refracted path.
///
/// `axis` ("Realistic Water"): with s = strength * tilt, red is looked up at uv' + (s.x, 0), green
/// at uv' + s / 2, blue at uv' + (0, s.y). Not dispersion: the shifts follow the screen's axes, not
/// the direction of refraction, and do not grow with depth. Kept as the article has it.
///
/// `dispersion`: each channel has an index of refraction of its own, and Refraction bends it by
/// that: water.ior + gain (n(650, 550, 450 nm) - n(550 nm)), with the indices of water at 20 C
/// (Daimon & Masumura 2007, "Measurement of the refractive index of distilled water from the
/// near-infrared region to the ultraviolet region"). gain 1 is water. Three wavelengths stand for
/// three bands: at a large gain colors part in steps where real light has a spectrum.
struct PrismSplit {
  enum class Model { kAxis, kDispersion };
  struct Params {
    Model model = Model::kDispersion;
    double strength = 0;
    double gain = 1;
  };

  static constexpr std::string_view kName = "prism_split";
  static constexpr std::string_view kAbout = "Splits the refracted lookup by color channel.";
  static constexpr StateSet kUses{StatePart::kNormal};
  static constexpr StateSet kMakes{StatePart::kPrism};
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params&) { return {}; }
  static Needs needs(const Params&) { return {}; }
  static double reach(const Params& p) {  // added to refraction's
    return p.model == Model::kAxis ? abs(p.strength) : 0;
  }
  static bool neutral(const Params& p, StateSet made) {
    if (p.model == Model::kDispersion) return p.gain == 0;
    return p.strength == 0 || !made.has(StatePart::kNormal);
  }
  static double bound(const Params& params, const Pass& c, const Ranges& ranges);
  /// How many times as far as the common one the channels' lookups go, where refraction offsets
  /// them by their index.
  static double stretch(const Params& params, const Pass& c);

  static double ns(const Params&, const Running&) { return 0.3; }

  template <class Strip>
  static void apply(const Params& params, const Pass&, Strip& strip) {
    using F = typename Strip::Number;
    if (params.model == Model::kDispersion) {
      const F red(params.gain * (water_index(kRedWavelength) - water_index(kGreenWavelength)));
      const F blue(params.gain * (water_index(kBlueWavelength) - water_index(kGreenWavelength)));
      return strip.each([&](Pixel<F>& p) {
        p.prism_r = p.prism_g = p.prism_b = {F(0), F(0)};
        p.dispersion = {red, F(0), blue};
      });
    }
    const F strength(params.strength);
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

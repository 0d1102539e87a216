#pragma once
#include "limpid/op/operator.h"
#include "limpid/optics/highlight.h"

namespace limpid {

/// The glint of the sun: strength * lobe^power * sun color * shadow at this pixel (lit where the
/// frame has no shadow), added to the picture and not bounded by 1. `phong` measures the lobe from
/// the mirrored light, `blinn_phong` ("Realistic Water", power 200) from the half vector.
struct SunHighlight {
  enum class Model { kPhong, kBlinnPhong };
  struct Params {
    Model model = Model::kBlinnPhong;
    double power = 200;
    double strength = 1;
  };

  static constexpr std::string_view kName = "sun_highlight";
  static constexpr std::string_view kAbout = "Glint of the sun, masked by its shadow.";
  static constexpr StateSet kUses{StatePart::kNormal};
  static constexpr StateSet kMakes{StatePart::kHighlight};
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params&) { return {PlaneId::kShadow}; }
  static Needs needs(const Params&) { return {.planes = {}, .sun = true}; }
  static double reach(const Params&) { return 0; }
  static bool neutral(const Params& p, StateSet) { return p.strength == 0; }

  template <class Strip>
  static void apply(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    const Vec3<F> to_sun = vec3_of<F>(c.sun.direction);
    const Rgb<F> light{F(params.strength * c.sun.color.r), F(params.strength * c.sun.color.g),
                       F(params.strength * c.sun.color.b)};
    const F power(params.power);
    const bool half_vector = params.model == Model::kBlinnPhong;
    strip.own(PlaneId::kShadow, [&](Pixel<F>& p, F shadow) {
      const F lobe = half_vector ? blinn_phong_lobe(p.normal, p.to_viewer, to_sun, power)
                                 : phong_lobe(p.normal, p.to_viewer, to_sun, power);
      p.highlight = (lobe * shadow) * light;
    });
  }
};

}  // namespace limpid

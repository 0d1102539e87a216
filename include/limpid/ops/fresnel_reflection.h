#pragma once
#include "limpid/op/operator.h"
#include "limpid/optics/fresnel.h"

namespace limpid {

/// Mirrors the surroundings: out = lerp(u, reflected, F).
///
/// F by `reflectance`, of the angle between the wave normal and the viewer: `rim` (the article's;
/// exponent `power`), `schlick` (with `f0`), `exact` (with water.ior). Source `planar`: the frame's
/// reflection planes; lookup `offset`: at uv + strength * tilt, bilinear. Reflection planes hold
/// what a flat mirror shows; far from the water the lookup may leave what the mirror saw, and
/// below-surface cuts show what was behind them.
struct FresnelReflection {
  enum class Reflectance { kRim, kSchlick, kExact };
  enum class Source { kPlanar };
  enum class Lookup { kOffset };
  struct Params {
    Reflectance reflectance = Reflectance::kExact;
    double power = 3;
    double f0 = 0.020373;
    Source source = Source::kPlanar;
    Lookup lookup = Lookup::kOffset;
    double strength = 0.02;
  };

  static constexpr std::string_view kName = "fresnel_reflection";
  static constexpr std::string_view kAbout = "Mixes in the mirrored surroundings by angle.";
  static constexpr StateSet kUses{StatePart::kNormal, StatePart::kTransmitted,
                                  StatePart::kInScatter};
  static constexpr StateSet kMakes{StatePart::kFresnel, StatePart::kReflected,
                                   StatePart::kTransmitted, StatePart::kInScatter};
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params&) { return kReflectionPlanes; }
  static Needs needs(const Params& p) { return {.planes = reads(p)}; }
  static double reach(const Params& p) { return abs(p.strength); }
  static bool neutral(const Params&, StateSet) { return false; }

  template <class Strip>
  static void apply(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    const F power(params.power), f0(params.f0), ior(c.ior), strength(params.strength);
    strip.each([&](Pixel<F>& p) {
      const F cosine = dot(p.to_viewer, p.normal);
      switch (params.reflectance) {
        case Reflectance::kRim:
          p.fresnel = fresnel_rim(cosine, power);
          break;
        case Reflectance::kSchlick:
          p.fresnel = fresnel_schlick(cosine, f0);
          break;
        case Reflectance::kExact:
          p.fresnel = fresnel_exact(cosine, ior);
          break;
      }
    });
    strip.bilinear_rgb(
        PlaneId::kReflectionR, [&](const Pixel<F>& p) { return strength * p.tilt; },
        [](Pixel<F>& p, Rgb<F> mirrored) {
          const F through = F(1) - p.fresnel;
          p.transmitted = through * p.transmitted;
          p.in_scatter = through * p.in_scatter;
          p.reflected = p.fresnel * mirrored;
        });
  }
};

}  // namespace limpid

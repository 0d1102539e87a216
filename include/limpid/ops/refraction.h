#pragma once
#include "limpid/op/operator.h"

namespace limpid {

/// Where the view ray ends under the water, and the light that comes from there.
///
/// `normal_offset` ("Realistic Water"): uv' = uv + strength * tilt. No depth, no index of
/// refraction: calm water does not shift at all.
///
/// What lies above the surface must not be seen through it. rejection `none` takes what is at uv'.
/// `snap` (the article's): where the dry depth nearest to uv' is in front of this pixel's surface,
/// uv' goes back to uv and the prism is switched off; confidence is 0 there. Its faults are kept:
/// only the centre of the three prism taps is tested, the color tap is bilinear where the depth tap
/// is nearest, and the choice is hard (a halo).
struct Refraction {
  enum class Model { kNormalOffset };
  enum class Rejection { kNone, kSnap };
  struct Params {
    Model model = Model::kNormalOffset;
    double strength = 0.03;
    Rejection rejection = Rejection::kSnap;
  };

  static constexpr std::string_view kName = "refraction";
  static constexpr std::string_view kAbout =
      "Looks up the dry picture where the refracted ray ends.";
  static constexpr StateSet kUses{StatePart::kNormal, StatePart::kPrism};
  static constexpr StateSet kMakes{StatePart::kPosition, StatePart::kTransmitted,
                                   StatePart::kConfidence};
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params&) { return kColorPlanes | PlaneSet{PlaneId::kDepth}; }
  static Needs needs(const Params& p) { return {.planes = reads(p)}; }
  static double reach(const Params& p) { return abs(p.strength); }
  static bool neutral(const Params& p, StateSet made) {
    return (p.strength == 0 || !made.has(StatePart::kNormal)) && !made.has(StatePart::kPrism);
  }

  template <class Strip>
  static void apply(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    const F strength(params.strength);
    strip.each([&](Pixel<F>& p) { p.shift = strength * p.tilt; });
    strip.nearest(
        PlaneId::kDepth, [](const Pixel<F>& p) { return p.shift; },
        [](Pixel<F>& p, F depth) { p.hit_depth = depth; });
    strip.each([&](Pixel<F>& p) {
      Vec2<F> prism_r = p.prism_r, prism_g = p.prism_g, prism_b = p.prism_b;
      if (params.rejection == Rejection::kSnap) {
        const auto above = p.hit_depth < p.surface_depth;
        const Vec2<F> none{F(0), F(0)};
        p.shift = select(above, none, p.shift);
        prism_r = select(above, none, prism_r);
        prism_g = select(above, none, prism_g);
        prism_b = select(above, none, prism_b);
        p.hit_depth = select(above, p.dry_depth, p.hit_depth);
        p.confidence = select(above, F(0), p.confidence);
      }
      p.shift_r = p.shift + prism_r;
      p.shift_g = p.shift + prism_g;
      p.shift_b = p.shift + prism_b;
    });
    if (c.made.has(StatePart::kPrism)) {
      strip.bilinear(
          PlaneId::kColorR, [](const Pixel<F>& p) { return p.shift_r; },
          [](Pixel<F>& p, F red) { p.transmitted.r = red; });
      strip.bilinear(
          PlaneId::kColorG, [](const Pixel<F>& p) { return p.shift_g; },
          [](Pixel<F>& p, F green) { p.transmitted.g = green; });
      strip.bilinear(
          PlaneId::kColorB, [](const Pixel<F>& p) { return p.shift_b; },
          [](Pixel<F>& p, F blue) { p.transmitted.b = blue; });
    } else {
      strip.bilinear_rgb(
          PlaneId::kColorR, [](const Pixel<F>& p) { return p.shift; },
          [](Pixel<F>& p, Rgb<F> color) { p.transmitted = color; });
    }
  }
};

}  // namespace limpid

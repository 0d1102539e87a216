#pragma once
#include "limpid/op/operator.h"

namespace limpid {

/// Lets the dry picture through the finished surface, as engines do that blend the water's surface
/// over the scene. Last in the chain; only where the view comes from the air.
///
/// `view_angle` (Rito15 2021): out = lerp(dry color at this pixel, out, a), a = sat(alpha - amount
/// sat(V.up)^power) with the calm normal, so that one sees through most straight down. The dry
/// color is neither refracted nor fogged, and counts as transmitted light. Where nothing was hit
/// behind the water there is nothing to let through: the surface stays as it is. Not physical: on
/// top of refraction and Fresnel, which say how much passes, it lets light through twice.
struct Penetration {
  enum class Model { kNone, kViewAngle };
  struct Params {
    Model model = Model::kNone;
    double alpha = 1;
    double amount = 0.2;
    double power = 5;
  };

  static constexpr std::string_view kName = "penetration";
  static constexpr std::string_view kAbout = "Blends the finished surface over the dry picture.";
  static constexpr StateSet kUses = kOutputTerms;
  static constexpr StateSet kMakes = kOutputTerms;
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params& p) {
    return p.model == Model::kNone ? PlaneSet{} : kColorPlanes;
  }
  static Needs needs(const Params& p) { return {.planes = reads(p)}; }
  static double reach(const Params&) { return 0; }
  static bool neutral(const Params& p, StateSet) {
    return p.model == Model::kNone || (p.alpha == 1 && p.amount == 0);
  }
  static double bound(const Params& params, const Pass& c, const Ranges& ranges);

  static double ns(const Params&, const Running&) { return 1.5; }

  template <class Strip>
  static void apply(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    if (params.model == Model::kNone) return;
    const Vec3<F> up = vec3_of<F>(c.up);
    const F alpha(params.alpha), amount(params.amount);
    strip.own3(PlaneId::kColorR, [&](Pixel<F>& p, Vec3<F> dry) {
      const F seen_through = amount * pow(saturate(dot(p.to_viewer, up)), params.power);
      const auto lets_through = p.side > F(0.5) && !nothing(p.dry_depth);
      const F a = select(lets_through, saturate(alpha - seen_through), F(1));
      p.transmitted = a * p.transmitted + (F(1) - a) * Rgb<F>{dry.x, dry.y, dry.z};
      p.in_scatter = a * p.in_scatter;
      p.reflected = a * p.reflected;
      p.highlight = a * p.highlight;
    });
  }
};

}  // namespace limpid

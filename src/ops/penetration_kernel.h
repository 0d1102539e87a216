#pragma once
#include "limpid/ops/penetration.h"

#include "op/operator.h"

namespace limpid {

template <>
struct Kernel<Penetration> : Penetration {
  static constexpr StateSet kUses = kOutputTerms;
  static constexpr StateSet kMakes = kOutputTerms;
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
    const F alpha = given<F>(params.alpha), amount = given<F>(params.amount);
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

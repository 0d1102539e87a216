#pragma once
#include <numbers>

#include "limpid/ops/sun_highlight.h"

#include "op/operator.h"
#include "op/sun_search.h"
#include "optics/highlight.h"

namespace limpid {

template <>
struct Kernel<SunHighlight> : SunHighlight {
  static constexpr StateSet kUses{StatePart::kNormal, StatePart::kSlopeVariance};
  static constexpr StateSet kMakes{StatePart::kHighlight};
  static PlaneSet reads(const Params& p) {
    const PlaneId other = p.model == Model::kSlopes ? PlaneId::kDepth : PlaneId::kShadow;
    return {other, PlaneId::kSurfaceShadow};
  }
  static Needs needs(const Params&) { return {.planes = {}, .sun = true}; }
  static double reach(const Params& p) { return p.model == Model::kSlopes ? HUGE_VAL : 0; }
  static bool neutral(const Params& p, StateSet) { return p.strength == 0; }
  static double bound(const Params& params, const Pass& c, const Ranges& ranges);
  static void propagate_ranges(const Params& params, const Pass& c, Ranges& ranges);

  static constexpr bool kLooksAbove = true;
  static double ns(const Params& p, const Running&) {
    return p.model == Model::kGgx ? 2.5 : p.model == Model::kSlopes ? 4 : 2;
  }

  template <class Strip>
  static void apply(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const bool physical = params.model == Model::kGgx || params.model == Model::kSlopes;
    const double scale = params.strength * (physical ? std::numbers::pi : 1);
    const Rgb<double>& sun = c.sun.color;
    const Rgb<F> light{given<F>(scale * sun.r, "sun_highlight.light", 0),
                       given<F>(scale * sun.g, "sun_highlight.light", 1),
                       given<F>(scale * sun.b, "sun_highlight.light", 2)};
    if (params.model == Model::kSlopes && !c.planes.has(PlaneId::kSurfaceShadow)) {
      return strip.probe([&](Pixel<F>& p, const auto& tap) {
        F seen = select(p.side > F(0.5), lobe(params, c, p), F(0));
        // Shorter than the search of murky water: a glint covers few pixels and shows no outline.
        constexpr MirrorSteps kSteps{16, 0.06, 0.03};
        const ScreenRay<F> to_sun(c, p, vec3_of<F>(c.sun.direction));
        if_any(seen > F(0),
               [&] { seen = seen * (F(1) - sun_met(c, p, tap, tap.wet(), to_sun, kSteps)); });
        p.highlight = seen * light;
      });
    }
    const PlaneId shadow =
        c.planes.has(PlaneId::kSurfaceShadow) ? PlaneId::kSurfaceShadow : PlaneId::kShadow;
    strip.own(shadow, [&](Pixel<F>& p, F visible) {
      const F lit = select(p.side > F(0.5), visible, F(0));
      p.highlight = (lobe(params, c, p) * lit) * light;
    });
  }

 private:
  template <class F>
  static LIMPID_INLINE F lobe(const Params& params, const Pass& c, const Pixel<F>& p) {
    const Vec3<F> n = p.normal, v = p.to_viewer, l = vec3_of<F>(c.sun.direction);
    const auto faces_sun = dot(n, l) > F(0);
    switch (params.model) {
      case Model::kPhong:
        return select(faces_sun, phong_lobe(n, v, l, params.power), F(0));
      case Model::kBlinnPhong:
        return select(faces_sun, blinn_phong_lobe(n, v, l, params.power), F(0));
      case Model::kGgx:
        if (params.roughness == 0) return sun_disc_lobe(n, v, l, given<F>(c.ior));
        return sun_glint_lobe(n, v, l, given<F>(params.roughness), given<F>(c.ior));
      case Model::kSlopes: {
        const double square = params.roughness * params.roughness;
        const F rough = given<F>(0.5 * square, "sun_highlight.variance");
        const Sym2<F> spread = p.slope_variance + Sym2<F>{rough, F(0), rough};
        return wave_glint_lobe(n, v, l, vec3_of<F>(c.up), vec3_of<F>(c.map_x), vec3_of<F>(c.map_y),
                               spread, given<F>(c.sun.radius(), "sun.radius"), given<F>(c.ior));
      }
    }
    return F(0);
  }
};

}  // namespace limpid

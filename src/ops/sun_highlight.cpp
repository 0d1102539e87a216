#include <algorithm>

#include "ops/sun_highlight_kernel.h"

namespace limpid {
namespace {

using P = SunHighlight::Params;

constexpr std::string_view kModels[] = {"phong", "blinn_phong", "ggx", "slopes"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "Model of the lobe."),
    real<&P::power>("power", "", {0, 1e5}, "Exponent of the lobe, not for ggx; larger is sharper.")
        .when("model", {"phong", "blinn_phong"}),
    real<&P::strength>("strength", "", {0, 1e6}, "Scales the glint; 0 is none."),
    real<&P::roughness>("roughness", "", {0, 1},
                        "Root mean square slope of waves too fine for the normals.")
        .when("model", {"ggx", "slopes"}),
};

}  // namespace

std::span<const Field<P>> SunHighlight::fields() { return kFields; }

/// Phong's lobes reach 1, and no mirror is brighter than the sun's disc.
double Kernel<SunHighlight>::bound(const P& params, const Pass& c, const Ranges& ranges) {
  const double radius = c.sun.radius();
  const double lobe = params.model == Model::kSlopes
                          ? std::numbers::pi * kBrightestLobe / (radius * radius)
                      : params.model == Model::kGgx ? std::numbers::pi / kSunSolidAngle
                                                    : 1;
  const bool finds_shadow =
      params.model == Model::kSlopes && !c.planes.has(PlaneId::kSurfaceShadow);
  const double light = std::max({c.sun.color.r, c.sun.color.g, c.sun.color.b});
  return params.strength * lobe * light * (finds_shadow ? 1 : std::max(ranges.own_shadow.max, 0.0));
}

void Kernel<SunHighlight>::propagate_ranges(const P& params, const Pass& c, Ranges& ranges) {
  ranges.above += bound(params, c, ranges);
}

}  // namespace limpid

#include <algorithm>

#include "ops/water_shadow_kernel.h"

namespace limpid {
namespace {

using P = WaterShadow::Params;

constexpr std::string_view kModels[] = {"darken", "scatter"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "What the shadow falls on."),
    real<&P::strength>("strength", "", {0, 1}, "How dark full shadow is: 0 not at all, 1 black."),
};

}  // namespace

std::span<const Field<P>> WaterShadow::fields() { return kFields; }

/// `darken` takes strength (1 - shadow) of all light from below, `scatter` of the sun's alone.
double Kernel<WaterShadow>::bound(const P& params, const Pass&, const Ranges& ranges) {
  const auto off = [](const Range& shadow) { return std::max(1 - shadow.min, shadow.max - 1); };
  if (params.model == Model::kDarken) {
    return bound_product(params.strength * off(ranges.shadow), ranges.light);
  }
  return bound_product(params.strength * std::max(off(ranges.shadow), off(ranges.shadow_of_water)),
                       ranges.sun_light);
}

double Kernel<WaterShadow>::displaced(const P& params, const Ranges& ranges) {
  const Range &there = ranges.shadow, &own = ranges.shadow_of_water;
  if (params.model == Model::kDarken) {
    return bound_product(params.strength * (there.max - there.min), ranges.light);
  }
  const double spread = std::max(there.max, own.max) - std::min(there.min, own.min);
  return bound_product(params.strength * spread, ranges.sun_far);
}

}  // namespace limpid

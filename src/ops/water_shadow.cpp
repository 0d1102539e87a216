#include <algorithm>

#include "ops/water_shadow_kernel.h"

namespace limpid {
namespace {

using P = WaterShadow::Params;

constexpr std::string_view kModels[] = {"darken", "scatter"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "Light that the shadow removes."),
    real<&P::strength>("strength", "", {0, 1}, "Darkness of full shadow: 0 none, 1 black."),
    real<&P::shafts>("shafts", "", {0, 1}, "Shafts of focused sunlight: 0 none, 1 physical.")
        .when("model", {"scatter"}),
};

}  // namespace

std::span<const Field<P>> WaterShadow::fields() { return kFields; }

/// `darken` removes strength (1 - shadow) of all light from below, `scatter` of the sunlight only.
double Kernel<WaterShadow>::bound(const P& params, const Pass& c, const Ranges& ranges) {
  const auto off = [](const Range& shadow) { return std::max(1 - shadow.min, shadow.max - 1); };
  if (params.model == Model::kDarken) {
    return bound_product(params.strength * off(ranges.shadow), ranges.light);
  }
  return bound_product(params.strength * std::max(off(ranges.shadow), off(ranges.shadow_of_water)),
                       ranges.sun_light) +
         brightened(params, c, ranges);
}

/// The largest and the smallest value of the table, applied to all light of an unshaded sun.
double Kernel<WaterShadow>::brightened(const P& params, const Pass& c, const Ranges& ranges) {
  if (!wants_shafts(params) || (c.caustics && !c.caustics->in_water)) return 0;
  const CausticsTable* table = c.caustics ? c.caustics->in_water : nullptr;
  const double change =
      table ? std::max(table->most - 1, 1 - std::max(table->least, 0.0)) : HUGE_VAL;
  const double lit = std::max({1.0, ranges.shadow.max, ranges.shadow_of_water.max});
  return bound_product(1.0001 * params.shafts * lit, bound_product(change, ranges.sun_light));
}

void Kernel<WaterShadow>::propagate_ranges(const P& params, const Pass& c, Ranges& ranges) {
  ranges.shafts = brightened(params, c, ranges);
  ranges.light += ranges.shafts;
}

double Kernel<WaterShadow>::displaced(const P& params, const Ranges& ranges) {
  const Range &there = ranges.shadow, &own = ranges.shadow_of_water;
  if (params.model == Model::kDarken) {
    return bound_product(params.strength * (there.max - there.min), ranges.light);
  }
  const double spread = std::max(there.max, own.max) - std::min(there.min, own.min);
  // Another path may have the brightest light instead of the darkest.
  return bound_product(params.strength * spread, ranges.sun_far) + 2 * ranges.shafts;
}

}  // namespace limpid

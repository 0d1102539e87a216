#include <algorithm>
#include <cmath>

#include "ops/prism_split_kernel.h"

namespace limpid {
namespace {

using P = PrismSplit::Params;

constexpr std::string_view kModels[] = {"axis", "dispersion"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "Model of the dispersion."),
    real<&P::strength>("strength", "uv per unit tilt", {-10, 10},
                       "Width of the axis split; 0 is none.")
        .when("model", {"axis"}),
    real<&P::gain>("gain", "", {0, 100}, "Factor of the dispersion of water; 0 is none, 1 water.")
        .when("model", {"dispersion"}),
};

}  // namespace

std::span<const Field<P>> PrismSplit::fields() { return kFields; }

/// Each channel of a lookup becomes another value in reach, as does the albedo that the fog takes
/// from it; its path stays the common path.
double Kernel<PrismSplit>::bound(const P&, const Pass&, const Ranges& ranges) {
  return bound_product(ranges.transmittance, ranges.contrast()) + ranges.detail;
}

double Kernel<PrismSplit>::stretch(const P& params, const Pass& c) {
  if (params.model != Model::kDispersion || c.ior <= 1) return 1;
  const Rgb<double> index = water_index_rgb();
  const double widest = std::max(std::abs(index.r - index.g), std::abs(index.b - index.g));
  return 1 + params.gain * widest / (c.ior - 1);
}

}  // namespace limpid

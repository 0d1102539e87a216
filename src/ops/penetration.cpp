#include <algorithm>
#include <cmath>

#include "ops/penetration_kernel.h"

namespace limpid {
namespace {

using P = Penetration::Params;

constexpr std::string_view kModels[] = {"none", "view_angle"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model",
                               "Model of the share of the dry picture that shows through."),
    real<&P::alpha>("alpha", "", {0, 1}, "Opacity of the surface seen at grazing angles.")
        .when("model", {"view_angle"}),
    real<&P::amount>("amount", "", {0, 1}, "Decrease of the opacity straight down.")
        .when("model", {"view_angle"}),
    real<&P::power>("power", "", {0, 100},
                    "Exponent of V.up; larger values limit the amount to views straight down.")
        .when("model", {"view_angle"}),
};

}  // namespace

std::span<const Field<P>> Penetration::fields() { return kFields; }

/// The transmitted light, strongest where the view is steepest, replaces as large a share of the
/// finished surface.
double Kernel<Penetration>::bound(const P& params, const Pass&, const Ranges& ranges) {
  if (params.model == Model::kNone) return 0;
  const double through = params.amount * std::pow(ranges.cosine().max, params.power);
  const double away = 1 - std::clamp(params.alpha - through, 0.0, 1.0);
  return bound_product(away, ranges.brightest() + ranges.light + ranges.above);
}

}  // namespace limpid

#include "limpid/ops/penetration.h"

namespace limpid {
namespace {

using P = Penetration::Params;

constexpr std::string_view kModels[] = {"none", "view_angle"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "What the share that is let through depends on."),
    real<&P::alpha>("alpha", "", {0, 1}, "Opacity of the surface seen at grazing angles."),
    real<&P::amount>("amount", "", {0, 1}, "How much less opaque it is seen straight down."),
    real<&P::power>("power", "", {0, 100},
                    "Exponent of V.up; larger keeps the amount to views straight down."),
};

}  // namespace

std::span<const Field<P>> Penetration::fields() { return kFields; }

}  // namespace limpid

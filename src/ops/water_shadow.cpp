#include "limpid/ops/water_shadow.h"

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

}  // namespace limpid

#include "limpid/ops/prism_split.h"

namespace limpid {
namespace {

using P = PrismSplit::Params;

constexpr std::string_view kModels[] = {"axis", "dispersion"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "How the channels part."),
    real<&P::strength>("strength", "uv per unit tilt", {-10, 10},
                       "Width of the axis split; 0 is none."),
    real<&P::gain>("gain", "", {0, 100}, "Times the dispersion of water; 0 is none, 1 water."),
};

}  // namespace

std::span<const Field<P>> PrismSplit::fields() { return kFields; }

}  // namespace limpid

#include "limpid/ops/prism_split.h"

namespace limpid {
namespace {

using P = PrismSplit::Params;

constexpr std::string_view kModels[] = {"axis"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "How the channels part."),
    real<&P::strength>("strength", "uv per unit tilt", {-10, 10}, "Width of the split; 0 is none."),
};

}  // namespace

std::span<const Field<P>> PrismSplit::fields() { return kFields; }

}  // namespace limpid

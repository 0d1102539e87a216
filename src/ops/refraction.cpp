#include "limpid/ops/refraction.h"

namespace limpid {
namespace {

using P = Refraction::Params;

constexpr std::string_view kModels[] = {"normal_offset"};
constexpr std::string_view kRejections[] = {"none", "snap"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "How the refracted position is found."),
    real<&P::strength>("strength", "uv per unit tilt", {-10, 10}, "Size of the offset; 0 is none."),
    choice<&P::rejection, kRejections>("rejection",
                                       "What is done where the lookup lands above the surface."),
};

}  // namespace

std::span<const Field<P>> Refraction::fields() { return kFields; }

}  // namespace limpid

#include "limpid/ops/depth_fog.h"

namespace limpid {
namespace {

using P = DepthFog::Params;

constexpr std::string_view kModels[] = {"linear"};
constexpr std::string_view kDistances[] = {"eye", "ray"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "How light dies away with distance."),
    choice<&P::distance, kDistances>("distance", "How the way through the water is measured."),
    real<&P::density>("density", "1/scene unit", {0, 1e6}, "Slope of the linear fog."),
    real<&P::offset>("offset", "", {-1e6, 1e6},
                     "Taken off the linear fog; clear water up to offset / density."),
    color<&P::color>("color", "radiance", {0, 1e6}, "What the water itself looks like."),
    real<&P::alpha>("alpha", "", {0, 1}, "Share of the linear fog that is blended in."),
};

}  // namespace

std::span<const Field<P>> DepthFog::fields() { return kFields; }

}  // namespace limpid

#include "limpid/ops/sun_highlight.h"

namespace limpid {
namespace {

using P = SunHighlight::Params;

constexpr std::string_view kModels[] = {"phong", "blinn_phong", "ggx"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "How the lobe is measured."),
    real<&P::power>("power", "", {0, 1e5}, "Exponent of the lobe, not for ggx; larger is sharper."),
    real<&P::strength>("strength", "", {0, 1e6}, "Scales the glint; 0 is none."),
    real<&P::roughness>("roughness", "", {0, 1},
                        "Width of the lobe of ggx, its alpha: the root of the mean square slope."),
};

}  // namespace

std::span<const Field<P>> SunHighlight::fields() { return kFields; }

}  // namespace limpid

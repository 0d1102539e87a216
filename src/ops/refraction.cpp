#include "limpid/ops/refraction.h"

namespace limpid {
namespace {

using P = Refraction::Params;

constexpr std::string_view kModels[] = {"normal_offset", "dudv_offset", "snell"};
constexpr std::string_view kRejections[] = {"none", "snap", "shorten"};
constexpr std::string_view kSteps[] = {"march"};
constexpr std::string_view kOffFrames[] = {"clamp", "shorten", "fog"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "How the refracted position is found."),
    real<&P::strength>("strength", "uv per unit tilt", {-10, 10},
                       "Size of the offset, not for snell; 0 is none."),
    choice<&P::rejection, kRejections>("rejection",
                                       "What is done where the lookup lands above the surface."),
    count_or_word<&P::steps, kSteps>(
        "steps", "", {0, 64},
        "How often snell reads the depth again; march walks along the ray until it meets it."),
    choice<&P::off_frame, kOffFrames>("off_frame",
                                      "What is seen where the ray leaves the picture."),
};

}  // namespace

std::span<const Field<P>> Refraction::fields() { return kFields; }

}  // namespace limpid

#include "limpid/ops/fresnel_reflection.h"

namespace limpid {
namespace {

using P = FresnelReflection::Params;

constexpr std::string_view kReflectances[] = {"rim", "schlick", "exact"};
constexpr std::string_view kSources[] = {"planar"};
constexpr std::string_view kLookups[] = {"offset"};

constexpr Field<P> kFields[] = {
    choice<&P::reflectance, kReflectances>("reflectance", "How much is reflected at which angle."),
    real<&P::power>("power", "", {0, 100}, "Exponent of rim."),
    real<&P::f0>("f0", "", {0, 1}, "Reflectance at normal incidence, for schlick."),
    choice<&P::source, kSources>("source", "What is mirrored."),
    choice<&P::lookup, kLookups>("lookup", "Where in the source each pixel looks."),
    real<&P::strength>("strength", "uv per unit tilt", {-10, 10}, "Size of the lookup offset."),
};

}  // namespace

std::span<const Field<P>> FresnelReflection::fields() { return kFields; }

}  // namespace limpid

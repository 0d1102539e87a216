#include <algorithm>
#include <cmath>

#include "ops/fresnel_reflection_kernel.h"

namespace limpid {
namespace {

using P = FresnelReflection::Params;

constexpr std::string_view kReflectances[] = {"rim", "linear", "inverse_power", "schlick", "exact"};
constexpr std::string_view kSources[] = {"planar", "environment", "constant", "auto"};
constexpr std::string_view kFacets[] = {"mean", "spread"};
constexpr std::string_view kLookups[] = {"offset", "ray"};

constexpr Field<P> kFields[] = {
    choice<&P::reflectance, kReflectances>("reflectance", "Model of the reflectance by angle."),
    real<&P::power>("power", "", {0, 100}, "Exponent of rim and inverse_power.")
        .when("reflectance", {"rim", "inverse_power"}),
    real<&P::intensity>("intensity", "", {0, 100},
                        "Transmittance of inverse_power at normal incidence.")
        .when("reflectance", {"inverse_power"}),
    real<&P::f0>("f0", "", {0, 1}, "Reflectance at normal incidence, for schlick.")
        .when("reflectance", {"schlick"}),
    choice<&P::source, kSources>("source", "Source of the reflected light."),
    choice<&P::lookup, kLookups>(
        "lookup", "Lookup in the planar source: by an offset, or along the mirrored ray.")
        .when("source", {"planar", "auto"}),
    choice<&P::facets, kFacets>(
        "facets", "Waves smaller than a pixel: the mean facet, or the spread of facets."),
    real<&P::strength>("strength", "uv per unit tilt", {-10, 10}, "Size of the lookup offset.")
        .when("source", {"planar", "auto"})
        .when("lookup", {"offset"}),
    color<&P::color>("color", "radiance", {0, 1e6}, "Color of the constant source.")
        .when("source", {"constant", "auto"}),
};

}  // namespace

std::span<const Field<P>> FresnelReflection::fields() { return kFields; }

/// F is at most 1. The values of planes and surroundings are not bounded.
double Kernel<FresnelReflection>::bound(const P& params, const Pass&, const Ranges& ranges) {
  if (params.source != Source::kConstant) return HUGE_VAL;
  return std::max({params.color.r, params.color.g, params.color.b}) + ranges.light;
}

void Kernel<FresnelReflection>::propagate_ranges(const P& params, const Pass&, Ranges& ranges) {
  const bool known = params.source == Source::kConstant;
  ranges.above += known ? std::max({params.color.r, params.color.g, params.color.b}) : HUGE_VAL;
}

std::string_view Kernel<FresnelReflection>::prefer(P& params, const AtHand& has) {
  if (params.source != Source::kPlanar || !has.environment) return "";
  if (has.planes.covers(kReflectionPlanes)) return "";
  params.source = Source::kEnvironment;
  return "source environment: the frame has no reflection";
}

std::string_view Kernel<FresnelReflection>::looks_around(const P& params, const AtHand& has) {
  const bool planar = params.source == Source::kPlanar && has.planes.has(PlaneId::kReflectionValid);
  if (!has.environment || (!planar && params.source != Source::kAuto)) return "";
  const bool follows = params.source == Source::kAuto && params.lookup == Lookup::kRay;
  return has.planes.covers(kReflectionPlanes)
             ? follows ? "environment where the reflection is not valid, and beyond its edge"
                       : "environment where the reflection is not valid"
             : "environment where the picture does not show the mirrored objects";
}

std::string_view Kernel<FresnelReflection>::warning(const P& params, const AtHand& has) {
  if (params.source != Source::kPlanar || params.lookup != Lookup::kRay) return "";
  if (has.planes.has(PlaneId::kReflectionDepth)) return "";
  return "the reflection has no depth and counts as infinitely far; expected a reflection_depth, "
         "or fresnel_reflection.source = auto";
}

double Kernel<FresnelReflection>::ns(const P& p, const Running& running) {
  const bool cheap =
      p.reflectance != Reflectance::kRim && p.reflectance != Reflectance::kInversePower;
  const double formula = cheap ? 0.6 : 1.5;
  if (p.source == Source::kConstant) return formula;
  const double facets = p.facets == Facets::kSpread ? 1.6 : 1;
  if (p.source == Source::kEnvironment) return formula + 8 * facets;
  const bool depth = running.planes.has(PlaneId::kReflectionDepth);
  if (p.source == Source::kAuto) {
    if (!running.planes.covers(kReflectionPlanes)) return formula + 150 * facets;
    if (depth || running.completed.has(PlaneId::kReflectionDepth)) return formula + 55 * facets;
  }
  const bool probes = running.planes.has(PlaneId::kReflectionValid);
  if (p.lookup == Lookup::kOffset) return formula + (probes ? 12 : 3);
  return formula + (depth ? 30 : probes ? 16 : 4);
}

}  // namespace limpid

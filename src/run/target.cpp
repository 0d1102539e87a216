#include "limpid/run/target.h"

#include <limits>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr StateSet kLookups{StatePart::kPosition};

constexpr AovInfo kAovs[kAovCount] = {
    {"transmitted",
     "RGB",
     {StatePart::kTransmitted},
     0,
     Storage::kHalf,
     Filter::kMean,
     "light from below the surface; the dry picture on dry pixels"},
    {"in_scatter",
     "RGB",
     {StatePart::kInScatter},
     0,
     Storage::kHalf,
     Filter::kMean,
     "light scattered by the water"},
    {"reflected",
     "RGB",
     {StatePart::kReflected},
     0,
     Storage::kHalf,
     Filter::kMean,
     "light reflected by the surface"},
    {"highlight",
     "RGB",
     {StatePart::kHighlight},
     0,
     Storage::kHalf,
     Filter::kMean,
     "glint of the sun"},
    {"fresnel", "Y", {StatePart::kFresnel}, 0, Storage::kHalf, Filter::kMean, "reflectance"},
    {"transmittance",
     "RGB",
     {StatePart::kTransmittance},
     1,
     Storage::kHalf,
     Filter::kMean,
     "share of light transmitted along the path in the water"},
    {"path",
     "Z",
     {StatePart::kPath},
     0,
     Storage::kFloat,
     Filter::kMiddle,
     "length of the refracted ray in the water, scene units"},
    {"confidence",
     "Y",
     {StatePart::kConfidence},
     1,
     Storage::kHalf,
     Filter::kMean,
     "1 where the lookup found the end of the ray, 0 where the light is a guess",
     {},
     true},
    {"normal",
     "XYZ",
     {StatePart::kNormal},
     0,
     Storage::kHalf,
     Filter::kMiddle,
     "unit world normal of the waves, 0 on dry pixels"},
    {"surface_depth",
     "Z",
     {},
     std::numeric_limits<float>::infinity(),
     Storage::kFloat,
     Filter::kMiddle,
     "eye depth of the water, inf on dry pixels"},
    {"stmap.r", "UV", kLookups, 0, Storage::kFloat, Filter::kMiddle,
     "position at which red was looked up, (0, 0) the lower left"},
    {"stmap.g", "UV", kLookups, 0, Storage::kFloat, Filter::kMiddle,
     "position at which green was looked up"},
    {"stmap.b", "UV", kLookups, 0, Storage::kFloat, Filter::kMiddle,
     "position at which blue was looked up"},
    {"mirror_sources",
     "RGB",
     {StatePart::kMirrorSources},
     0,
     Storage::kHalf,
     Filter::kMean,
     "shares of the reflected light: from the reflection, from the picture itself, from the far "
     "surroundings",
     {},
     true},
    {"reflection_depth",
     "Z",
     {},
     std::numeric_limits<float>::infinity(),
     Storage::kFloat,
     Filter::kMiddle,
     "eye depth of the reflection, from the plate or computed; inf where it is not read",
     {PlaneId::kReflectionDepth},
     true},
    {"reflection_valid",
     "Y",
     {},
     0,
     Storage::kHalf,
     Filter::kMean,
     "validity of the reflection, from the plate or computed; 0 where it is not read",
     {PlaneId::kReflectionValid},
     true},
    {"sky",
     "RGB",
     {},
     0,
     Storage::kHalf,
     Filter::kMean,
     "the reflected sky, from the plate or computed; 0 where it is not read",
     kSkyPlanes,
     true},
    {"surface_shadow",
     "Y",
     {},
     1,
     Storage::kHalf,
     Filter::kMean,
     "lit share of the water's surface, from the plate or computed; 1 where it is not read",
     {PlaneId::kSurfaceShadow},
     true},
};

}  // namespace

std::span<const AovInfo> aovs() { return kAovs; }

Aov aov_named(std::string_view name) {
  std::vector<std::string> known;
  for (int i = 0; i < kAovCount; ++i) {
    if (kAovs[i].name == name) return static_cast<Aov>(i);
    known.emplace_back(kAovs[i].name);
  }
  throw Error("'" + std::string(name) + "' is not an AOV: expected one of " + join(known) +
              did_you_mean(name, known));
}

StateSet state_shown_by(std::span<const Aov> list) {
  StateSet shown;
  for (Aov aov : list) shown = shown | kAovs[static_cast<std::size_t>(aov)].parts;
  return shown;
}

}  // namespace limpid

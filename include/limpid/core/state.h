#pragma once
#include <cstdint>
#include <iterator>
#include <string_view>

#include "limpid/core/enum_set.h"

namespace limpid {

/// The parts of a pixel's state. Operators declare the parts that they use and the parts that they
/// make.
enum class StatePart : std::uint8_t {
  kNormal,         ///< wave normal and its tilt
  kSlopeVariance,  ///< slope variance of the waves that the pixel does not resolve
  kPrism,          ///< offset of each color channel from the common ray
  kPosition,       ///< ends of the refracted rays in the dry picture
  kPath,           ///< length of the refracted ray in the water
  kTransmittance,  ///< share of light transmitted along the path
  kDryBottom,      ///< light from below the surface, as lit in the dry picture
  kTransmitted,    ///< light from below the surface
  kInScatter,      ///< light scattered into the view by the water
  kSunScatter,     ///< the sun's part of in-scatter
  kFresnel,        ///< reflectance
  kReflected,      ///< light reflected by the surface
  kMirrorSources,  ///< sources of the reflected light
  kHighlight,      ///< the sun's glint
  kConfidence,     ///< 1 where the lookup found its ray, 0 for a guess
};

using StateSet = EnumSet<StatePart>;

/// Names in the order of StatePart.
inline constexpr std::string_view kStatePartNames[] = {
    "normal",        "slope_variance", "prism",          "position",   "path",
    "transmittance", "dry_bottom",     "transmitted",    "in_scatter", "sun_scatter",
    "fresnel",       "reflected",      "mirror_sources", "highlight",  "confidence"};
static_assert(std::size(kStatePartNames) == static_cast<std::size_t>(StatePart::kConfidence) + 1);

inline constexpr StateSet kWholeState{
    StatePart::kNormal,        StatePart::kSlopeVariance, StatePart::kPrism,
    StatePart::kPosition,      StatePart::kPath,          StatePart::kTransmittance,
    StatePart::kDryBottom,     StatePart::kTransmitted,   StatePart::kInScatter,
    StatePart::kSunScatter,    StatePart::kFresnel,       StatePart::kReflected,
    StatePart::kMirrorSources, StatePart::kHighlight,     StatePart::kConfidence};

/// The terms whose sum is the picture.
inline constexpr StateSet kOutputTerms{StatePart::kTransmitted, StatePart::kInScatter,
                                       StatePart::kReflected, StatePart::kHighlight};

}  // namespace limpid

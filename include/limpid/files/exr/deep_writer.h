#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "limpid/core/plane.h"
#include "limpid/files/exr/exr_heading.h"

namespace limpid {

/// Depths from here on are infinite.
inline constexpr float kInfiniteDepth = 1e9f;
inline constexpr float kLargestDepth = 999999936;  ///< the float before

/// The water of a picture as a volume, for compositors that work in depth. The views must cover the
/// data window; depths are eye depths.
struct DeepWater : ExrHeading {
  View<const float> front;  ///< surface eye depth; +inf: no water here
  View<const float> back;   ///< where the water ends; +inf: it does not
  /// The transmittance 0 ... 1 from front to back.
  std::array<View<const float>, 3> transmittance;
  std::array<View<const float>, 3> in_scatter;  ///< color of the whole volume, premultiplied
  /// Extinction per unit of eye depth, 1/unit; decides where infinitely deep water ends.
  std::array<double, 3> extinction{};
  std::string compression = "zips";  ///< none, rle, zips or "zips:level"; deep files have no other
  bool half = true;                  ///< R G B are stored as half; all else is always float
};

/// The length given to infinitely deep water; none if it has no extinction.
std::optional<double> deep_reach(const std::array<double, 3>& extinction);

/// Throws Error of Fault::kUsage for what is no DeepWater::compression.
void validate_deep_compression(const std::string& compression);

/// Writes a deep scan-line file with one volume sample where there is water and none elsewhere: Z,
/// ZBack, R G B (the in-scatter), AR AG AB (1 - transmittance) and A, their mean. By OpenEXR's
/// "Interpreting Deep Pixels" a part x of such a sample transmits T^x, which is Beer-Lambert, so
/// objects that are put into the water are absorbed correctly.
///
/// A sample of alpha 1 is opaque and cannot be split, so the alphas end at 1 - 2^-24, the largest
/// float below 1; half would end at 1 - 2^-11 and lose the density of all but shallow water. Denser
/// water (optical depth above 16.6 from front to back) is too clear in between. Infinitely deep
/// water ends where the light of every channel has fallen to 2^-24, 16.6 / the smallest extinction
/// above 0 behind the front; hosts fail on an infinite ZBack. With one sample per pixel the
/// channels with more absorption are then too clear in between.
///
/// Equal depths at front and back mean no water. Transmittance is clamped to 0 ... 1, half colors
/// to 65504. Throws Error for NaN, for a back before the front, for a color that is not finite and
/// for infinitely deep water without extinction; and as write_exr().
void write_deep_water(const std::filesystem::path& path, const DeepWater& water);

}  // namespace limpid

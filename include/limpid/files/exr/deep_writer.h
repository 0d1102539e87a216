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
inline constexpr float kLargestDepth = 999999936;  ///< the next smaller float

/// The water of a picture as a volume, for deep compositing. The views must cover the data window;
/// depths are eye depths.
struct DeepWater : ExrHeading {
  View<const float> front;  ///< depth of the surface; +inf where there is no water
  View<const float> back;   ///< depth at which the water ends; +inf for infinite water
  /// The transmittance 0 ... 1 from front to back.
  std::array<View<const float>, 3> transmittance;
  std::array<View<const float>, 3> in_scatter;  ///< color of the whole volume, premultiplied
  /// Extinction per unit of eye depth, 1/unit; gives the length of infinite water.
  std::array<double, 3> extinction{};
  std::string compression = "zips";  ///< none, rle, zips or "zips:level", as deep files permit
  bool half = true;  ///< R G B are stored as half; all other channels are always float
};

/// The length of the volume of infinite water, in scene units; empty without extinction.
std::optional<double> deep_reach(const std::array<double, 3>& extinction);

/// Throws Error of Fault::kUsage for an invalid DeepWater::compression.
void validate_deep_compression(const std::string& compression);

/// Writes a deep scan-line file, with one volume sample in pixels with water and none in others: Z,
/// ZBack, R G B (the in-scatter), AR AG AB (1 - transmittance) and A, their mean. By OpenEXR's
/// "Interpreting Deep Pixels" a share x of such a sample transmits T^x, which is the Beer-Lambert
/// law, so light of objects that are composited into the water is absorbed correctly.
///
/// A sample of alpha 1 is opaque and cannot be split, so alphas are at most 1 - 2^-24, the largest
/// float below 1; half would stop at 1 - 2^-11 and lose the density of all but shallow water.
/// Denser water (optical depth above 16.6 from front to back) is too clear in between. Infinite
/// water ends 16.6 / (the smallest extinction above 0) behind the front, where the light of every
/// channel has fallen to 2^-24, since hosts fail on an infinite ZBack. With one sample per pixel
/// the channels with more absorption are then too clear in between.
///
/// Equal depths at front and back mean no water. Transmittance is clamped to 0 ... 1, half colors
/// to 65504. Throws Error for NaN, for a back before the front, for a color that is not finite and
/// for infinitely deep water without extinction; and as write_exr().
void write_deep_water(const std::filesystem::path& path, const DeepWater& water);

}  // namespace limpid

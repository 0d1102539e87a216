#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "limpid/core/plane.h"

namespace limpid {

/// The place of the chain's lookup for one color of light, and the true place, in the convention of
/// the AOVs stmap.*: (0, 0) at the lower left of the display window, (1, 1) at the upper right.
struct OffsetChannel {
  View<const float> u, v;            ///< of the chain
  View<const float> true_u, true_v;  ///< of the truth; read only where `visible`
  /// From the truth: 1 where the looked-up picture shows that point, 0 where an object hides it.
  /// That picture is the dry one (TruthPicture::visible), or the layer below the water if the chain
  /// had it (visible_below).
  View<const float> visible;
};

/// Inputs for the error of the chain's geometry: AOVs of the chain and the planes of the same name
/// of a ray-traced picture. All windows must be equal.
struct OffsetPictures {
  Size display;
  View<const float> surface_depth;  ///< of the chain: +inf where there is no water
  View<const float> confidence;     ///< of the chain: the confirmed share of the lookup
  std::array<OffsetChannel, 3> channels;
};

/// Errors of one channel, or of the lookups of all channels. A lookup of a wet pixel is *accepted*
/// if `confidence` is .5 or more, else the chain used a guess; its point is *available* if
/// `visible` is .5 or more. Offsets are measured where the point is available and the lookup
/// accepted, in pixels. Where confidence or visible is NaN or inf, or a measured place is, the
/// error is infinite (a mismatch); likewise for a surface_depth of NaN or -inf.
struct OffsetErrors {
  std::int64_t wet = 0;                 ///< lookups of wet pixels: the base of the shares below
  std::int64_t measured = 0;            ///< including mismatches
  double median = 0, p95 = 0, max = 0;  ///< pixels; 0 if nothing was measured
  double wrongly_rejected = 0;          ///< available, but the chain used a guess
  double wrongly_accepted = 0;          ///< not available, but the chain used the texel found
  std::int64_t mismatches = 0;
};

struct OffsetComparison {
  std::array<OffsetErrors, 3> channels;  ///< red, green, blue
  OffsetErrors overall;
};

/// Throws Error for different windows and an empty display.
OffsetComparison offset_errors(const OffsetPictures& pictures);

/// One line for all channels, and one per channel, in the words of compare.
std::string to_text(const OffsetComparison& comparison);

}  // namespace limpid

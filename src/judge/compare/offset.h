#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "limpid/core/plane.h"

namespace limpid {

/// Where one color of light was looked up by the chain, and where it comes from in truth, as the
/// AOVs stmap.* have it: (0, 0) at the lower left of the display window, (1, 1) at the upper right.
struct OffsetChannel {
  View<const float> u, v;            ///< of the chain
  View<const float> true_u, true_v;  ///< of the truth; read only where `visible`
  /// Of the truth: 1 where the picture that the chain looks things up in has that point, 0 where
  /// something hides it. That picture is the dry one (TruthPicture::visible), or what lies below
  /// the water alone where the chain had that (visible_below).
  View<const float> visible;
};

/// What the error of the chain's geometry is computed from: AOVs of the chain beside the planes of
/// the same name of a ray-traced picture. All windows must be equal.
struct OffsetPictures {
  Size display;
  View<const float> surface_depth;  ///< of the chain: +inf where there is no water
  View<const float> confidence;     ///< of the chain: the share of the lookup that is real
  std::array<OffsetChannel, 3> channels;
};

/// Of one channel, or of the lookups of all. A lookup of a wet pixel is *accepted* where
/// `confidence` is .5 or more, else the chain fell back on something invented; it *can be had*
/// where `visible` is .5 or more. Offsets are measured where it can be had and is accepted, in
/// pixels. Where what says so is NaN or inf, or where a measured place is, the error is infinite (a
/// mismatch); so it is for a surface_depth of NaN or -inf.
struct OffsetErrors {
  std::int64_t wet = 0;                 ///< lookups of wet pixels: the shares below are of these
  std::int64_t measured = 0;            ///< with mismatches
  double median = 0, p95 = 0, max = 0;  ///< pixels; 0 where nothing is measured
  double wrongly_rejected = 0;          ///< can be had, but the chain fell back
  double wrongly_accepted = 0;          ///< cannot be had, but the chain took what it found
  std::int64_t mismatches = 0;
};

struct OffsetComparison {
  std::array<OffsetErrors, 3> channels;  ///< red, green, blue
  OffsetErrors overall;
};

/// Throws Error for windows that differ and a display that is empty.
OffsetComparison offset_errors(const OffsetPictures& pictures);

/// A line of all, and one a channel, in the words of compare.
std::string to_text(const OffsetComparison& comparison);

}  // namespace limpid

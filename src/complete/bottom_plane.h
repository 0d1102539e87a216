#pragma once
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "limpid/complete/beyond.h"
#include "limpid/core/frame.h"

#include "op/pass.h"

namespace limpid {

/// The bottom that a frame shows under its water, taken for a plane. Relative to the eye.
struct BottomPlane {
  glm::dvec3 normal;  ///< unit, upwards
  double offset;      ///< dot(normal, p) of its points p
  double drop;        ///< of the middle of all that is seen under the water, below the calm surface
  double shallow;     ///< likewise, a twentieth of it lies higher
  double slack;       ///< what lies nearer to it than this is of the bottom, in scene units

  /// The depth at which a pixel's ray meets it; no finite one, or below 0, where it does not.
  double depth_on(const Pass& pass, double x, double y) const;
};

/// A texel of the bottom.
struct BottomSample {
  glm::dvec3 at;  ///< relative to the eye, along t, b and up of Pass
  double drop;    ///< below the calm surface
  double weight;  ///< more near the edge of the picture
};

/// The plane that most of the bottom lies in, posts, rocks and walls left out: the best of some
/// planes through three texels each (Fischler & Bolles 1981, "Random Sample Consensus"), then by
/// least squares. The texels near the edge of the picture count most, for rays leave it there.
/// Looks at a few thousand texels of what refraction looks up. Nothing where hardly any lies under
/// the water, and where the eye is not over the calm level. `room` is memory from one frame to the
/// next.
std::optional<BottomPlane> fit_bottom(const Frame& frame, const Pass& pass,
                                      std::vector<BottomSample>& room);
inline std::optional<BottomPlane> fit_bottom(const Frame& frame, const Pass& pass) {
  std::vector<BottomSample> room;
  return fit_bottom(frame, pass, room);
}

/// From where rays meet the bottom: for the sides those of each wet pixel at an edge, for the share
/// those of a few thousand wet pixels.
Beyond look_beyond(const BottomPlane& bottom, const Frame& frame, const Pass& pass);

}  // namespace limpid

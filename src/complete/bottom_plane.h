#pragma once
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "limpid/complete/off_frame.h"
#include "limpid/core/frame.h"

#include "op/pass.h"

namespace limpid {

/// A plane fitted to the bottom that a frame shows under its water. Relative to the eye.
struct BottomPlane {
  static constexpr double kSteepest = 1.5;  ///< slope of a bottom; a steeper surface is a wall

  glm::dvec3 normal;  ///< unit, upwards
  double offset;      ///< dot(normal, p) of its points p
  double drop;        ///< depth below the calm surface of the median surface under the water
  double shallow;     ///< likewise, with a twentieth of the surfaces higher
  double slack;  ///< surfaces nearer to the plane than this belong to the bottom, in scene units

  /// The depth at which a pixel's ray meets the plane; infinite or below 0 if it does not.
  double depth_on(const Pass& pass, double x, double y) const;
};

/// A texel of the bottom.
struct BottomSample {
  glm::dvec3 at;  ///< relative to the eye, along t, b and up of Pass
  double drop;    ///< below the calm surface
  double weight;  ///< larger near the edge of the picture
};

/// The plane of most of the bottom, without posts, rocks and walls: the best of several planes
/// through three texels each (Fischler & Bolles 1981, "Random Sample Consensus"), then least
/// squares. The texels near the edge of the picture count most, because rays leave it there.
/// Samples a few thousand texels of the planes that refraction looks up. Nothing if hardly any lie
/// under the water, or if the eye is not above the calm level. `room` is memory kept from frame to
/// frame.
std::optional<BottomPlane> fit_bottom(const Frame& frame, const Pass& pass,
                                      std::vector<BottomSample>& room);
inline std::optional<BottomPlane> fit_bottom(const Frame& frame, const Pass& pass) {
  std::vector<BottomSample> room;
  return fit_bottom(frame, pass, room);
}

/// The refracted lookups that leave the picture, by the intersections of refracted rays with this
/// plane: the overscan from each wet pixel at an edge, the share from a few thousand wet pixels.
OffFrameLookups off_frame_lookups(const BottomPlane& bottom, const Frame& frame, const Pass& pass);

}  // namespace limpid

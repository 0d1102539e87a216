#pragma once
#include <array>
#include <vector>

#include <glm/vec2.hpp>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "op/pass.h"

namespace limpid {

/// The sun's shadows on the water, from those on the surfaces of the dry picture: where the sun's
/// ray through a place of the water ends, unrefracted, the dry picture shows the same shadow.
/// Where the picture does not show that end, or something is seen between the two, it is searched
/// whether the picture shows a surface between the water and the sun (SunSight), every few pixels.
class SurfaceShadow {
 public:
  /// From depth, shadow and, if present, surface_depth; without it the water is calm. Needs a sun
  /// above the horizon: else, and where a pixel shows no water plane, 1. The same for any number of
  /// threads.
  void make(const Frame& frame, const Pass& pass, Executor& executor);

  const Plane& plane() const { return plane_; }

 private:
  /// The corner of a cell of pixels.
  struct Node {
    float lit;
    float known;     ///< in which share the picture shows the end of the sun's ray
    glm::dvec2 end;  ///< that end, in pixels
  };
  void find_even(const View<const float>& shadow, Executor& executor);
  bool is_even(const Rect& window, const std::array<const Node*, 4>& corners) const;

  Plane plane_;
  std::vector<Node> nodes_;
  Size blocks_{};
  std::vector<float> even_;  ///< the lit fraction of blocks of the shadow that have only one
};

}  // namespace limpid

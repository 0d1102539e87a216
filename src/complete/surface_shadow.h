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
/// ray through a point of the water ends, unrefracted, the dry picture shows the same shadow. Where
/// the picture does not show that end, or shows a surface in front of one of four points between,
/// a search tells whether the picture shows a surface between the water and the sun (SunSight).
///
/// Works in cells of four pixels, of eight in 4K, and by pixels where a cell's corners end in an
/// uneven shadow. Searches are made at the corners of cells and, at the edges of shadows, for
/// quarters of cells: of objects narrower than a cell, shadows that are searched may be lost.
class SurfaceShadow {
 public:
  /// From depth, shadow and, if present, surface_depth; without surface_depth the water is calm. 1
  /// without a sun above the horizon, and on pixels whose rays do not meet the water. In the window
  /// of depth. The same for any number of threads.
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

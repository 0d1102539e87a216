#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "op/edge_surfaces.h"
#include "op/pass.h"

namespace limpid {

/// Makes the surfaces at the picture's edge. Reads the outermost texels of color and depth.
class EdgeSurfacesMaker {
 public:
  /// Valid until the next call. The same for any number of threads.
  const EdgeSurfaces* make(const Frame& frame, const Pass& pass, Executor& executor);

 private:
  /// Of a place at the edge: red, green, blue and 1 of a surface above the water, 0 without one; 1
  /// of surface or sky; depth of the surface, and its square. Or sums of them from the first place
  /// on.
  using Numbers = std::array<double, 7>;

  EdgeSurfaces surfaces_;
  std::array<Plane, 6> planes_;  ///< colors, then shape
  std::vector<Numbers> sums_;
};

}  // namespace limpid

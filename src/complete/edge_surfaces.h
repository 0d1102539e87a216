#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "op/edge_surfaces.h"
#include "op/pass.h"

namespace limpid {

/// EdgeSurfaces::closed of a frame, 0 ... 1, by the upper edge of its depth.
double closed_share(const Frame& frame, const Pass& pass);

/// Makes the surfaces at the picture's edge. Reads the outermost texels of color and depth.
class EdgeSurfacesMaker {
 public:
  /// Valid until the next call. The same for any number of threads.
  const EdgeSurfaces* make(const Frame& frame, const Pass& pass, Executor& executor);

 private:
  /// Sums over pixels, from the first column on: red, green and blue of surfaces above the water,
  /// and what the names say.
  enum : std::size_t { kStands = 3, kAbove, kDepth, kSquare, kNumbers };
  using Numbers = std::array<double, kNumbers>;

  EdgeSurfaces surfaces_;
  std::array<Plane, 6> planes_;  ///< colors, then shape
  std::vector<Numbers> sums_;    ///< one more than columns
  std::vector<float> lights_;
};

}  // namespace limpid

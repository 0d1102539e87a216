#pragma once
#include "op/pass.h"

namespace limpid {

/// What refracted rays look up: the dry scene, or that below the water alone, where the frame has
/// it and the view does not begin in the water.
struct SeenPlanes {
  PlaneId color, depth;
  const Bounds& bounds;
  bool below;  ///< holds what lies under the crests of the water alone, +inf where there is nothing

  static SeenPlanes of(const Pass& pass) {
    if (pass.planes.covers(kBelowPlanes) && !pass.submersible)
      return {PlaneId::kBelowR, PlaneId::kBelowDepth, pass.below, true};
    return {PlaneId::kColorR, PlaneId::kDepth, pass.dry, false};
  }
};

}  // namespace limpid

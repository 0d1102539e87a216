#pragma once
#include <array>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "op/pass.h"

namespace limpid {

/// The layer below the water drawn on into the overscan of color and depth, where it has less of
/// its own: there it is what the dry scene shows under the calm level, and empty where something
/// stands higher.
class BelowOverscan {
 public:
  /// Replaces the frame's views, if color and depth go farther than the layer in any direction.
  /// What is kept is copied.
  void widen(Frame& frame, const Pass& pass, Executor& executor);

 private:
  std::array<Plane, 4> planes_;
};

}  // namespace limpid

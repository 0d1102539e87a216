#pragma once
#include <array>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "op/pass.h"

namespace limpid {

/// Extends the layer below the water into the overscan of color and depth, where its own is
/// smaller: there it shows the dry scene under the calm level, and is empty where an object stands
/// higher.
class BelowOverscan {
 public:
  /// Replaces the frame's views, if color and depth extend farther than the layer in any direction.
  /// Copies the texels that it keeps.
  void widen(Frame& frame, const Pass& pass, Executor& executor);

 private:
  std::array<Plane, 4> planes_;
};

}  // namespace limpid

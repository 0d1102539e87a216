#pragma once
#include <array>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "complete/pull_push.h"

namespace limpid {

/// The sky of a frame behind its objects: the color where no surface was hit and alpha is above
/// half, and elsewhere a smooth continuation of this color (pull_push.h).
class Sky {
 public:
  /// Reads color and depth. False, without a result, if the frame shows no sky.
  bool make(const Frame& frame, Executor& executor);

  const Plane& color(int channel) const { return color_[static_cast<std::size_t>(channel)]; }

 private:
  std::array<Plane, 3> color_;
  PullPush<3> sky_;
};

}  // namespace limpid

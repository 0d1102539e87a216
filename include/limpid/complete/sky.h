#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

namespace limpid {

/// The sky of a frame where something stands before it: the color where nothing was hit and alpha
/// is above half, and elsewhere a smooth continuation of it, by a pyramid of means (Gortler et al.
/// 1996, "The Lumigraph", pull-push).
class Sky {
 public:
  /// Looks at color and depth. False, and nothing is made, where the frame shows no sky.
  bool make(const Frame& frame, Executor& executor);

  const Plane& color(int channel) const { return color_[static_cast<std::size_t>(channel)]; }

 private:
  /// Means of a quarter of a level's texels each, and how much sky is in them.
  struct Level {
    Rect window;
    std::vector<std::array<float, 4>> texels;  ///< r g b share
    std::array<float, 4>& at(int x, int y) {
      return texels[static_cast<std::size_t>(y) * window.width() + x];
    }
  };

  void fill(Level& finer, Level& coarser, Executor& executor) const;

  std::array<Plane, 3> color_;
  std::vector<Level> levels_;
};

}  // namespace limpid

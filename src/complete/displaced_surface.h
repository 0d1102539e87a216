#pragma once
#include <string>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "core/water_view.h"
#include "op/raised_water.h"

namespace limpid {

/// The depth of water that sine waves raise and lower: for each pixel the first point at which its
/// ray meets the surface z = sum of the sines of WaterView::waves.
///
/// Made for waves that are known as such, of the scene or of the look. Water from tiling maps or
/// from the frame's own normals stays flat: those say how the surface leans, and what a map adds up
/// to is no height.
class DisplacedSurface {
 public:
  /// Looks at the window of the dry depth. `simd` as in FusedOptions; without it in double.
  void make(const Frame& frame, const WaterView& view, Executor& executor, const std::string* simd);

  const Plane& depth() const { return depth_; }  ///< eye depth, +inf where no water is met

 private:
  RaisedWater<float> water_;
  RaisedWater<double> exact_water_;
  Plane depth_;
};

}  // namespace limpid

#pragma once
#include <string>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "core/water_view.h"
#include "op/raised_water.h"

namespace limpid {

/// The depth of water raised by sine waves: for each pixel, the first point at which its ray meets
/// the surface z = sum of the sines of WaterView::waves.
///
/// Only for waves with known heights, of the scene or of the look. Water with tiling maps or the
/// frame's own normals stays flat: these give slopes, which do not sum to heights.
class DisplacedSurface {
 public:
  /// Reads the window of the dry depth. `simd` as in FusedOptions; without it in double.
  void make(const Frame& frame, const WaterView& view, Executor& executor, const std::string* simd);

  const Plane& depth() const { return depth_; }  ///< eye depth, +inf where no water is met

 private:
  RaisedWater<float> water_;
  RaisedWater<double> exact_water_;
  Plane depth_;
};

}  // namespace limpid

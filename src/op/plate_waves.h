#pragma once
#include "limpid/core/vec.h"

namespace limpid {

/// Statistics of the waves on the frame's own surface, or of the sines that raise the water
/// (complete/plate_waves.h). Slopes along WaterView::map_x and map_y count as a Gaussian field:
/// those of two places at the distance r have the covariance variance exp(-r' turn r / 2).
struct PlateWaves {
  /// 0: the surface is flat at this distance; 1: waves raise it. A ramp in between, so that a
  /// rising camera sees no sudden change.
  double raised = 0;
  Sym2<double> variance{0, 0, 0};
  Sym2<double> turn{0, 0, 0};  ///< 1 / scene unit squared; of one sine its wave vector squared
  /// Between neighbouring pixels x / (1 + smooth x) stands for x = r' turn r: far pixels of a mesh,
  /// whose faces are large, have more in common than waves of that turn have.
  double smooth = 0;
};

}  // namespace limpid

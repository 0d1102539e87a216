#pragma once
#include "limpid/core/vec.h"

namespace limpid {

/// What the frame's own surface says of its waves as a whole (complete/plate_waves.h). Slopes along
/// WaterView::map_x and map_y are taken for a Gaussian field: those of two places at the distance r
/// have the covariance variance exp(-r' turn r / 2).
struct PlateWaves {
  /// 0: the surface is a plane, seen from so far; 1: waves raise it. Between them it fades, for a
  /// camera that rises must not see one become the other in a frame.
  double raised = 0;
  Sym2<double> variance{0, 0, 0};
  Sym2<double> turn{0, 0, 0};  ///< 1 / scene unit squared; of one sine its wave vector squared
};

}  // namespace limpid

#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "complete/pull_push.h"
#include "op/bottom_layer.h"
#include "op/pass.h"

namespace limpid {

/// Makes the layer of the bottom that refraction looks up where a ray goes behind an object.
///
/// In cells of a few pixels, about as many for each size of picture. What stands up from the bottom
/// is what a grey closing of the depth below the water fills (Serra 1982, "Image Analysis and
/// Mathematical Morphology"), by windows of three cells to a quarter of the picture: the smallest
/// that fills it tells its width, of which a quarter is taken for its thickness. The bottom is then
/// drawn on over these cells and those of objects above the water, by a pyramid of means. The share
/// of water without a bottom is extended over these cells in the same way.
class BottomLayerMaker {
 public:
  /// Null where no object stands in front of the bottom, no bottom is visible, the eye is in the
  /// water, or the frame has a layer below the water. Valid until the next call. The same for any
  /// number of threads.
  const BottomLayer* make(const Frame& frame, const Pass& pass, Executor& executor);

 private:
  struct Cell {
    float highest;   ///< of its texels, as depth below the calm surface, 0 where one is above
    float nearness;  ///< 1 / eye depth there
    float width;     ///< of the cell there, in scene units
    float bottom;    ///< what reaches down to this is of the bottom
    int window;      ///< the smallest, in cells, that fills what stands there; 0 where nothing does
    float looks, standing;  ///< texels looked at, and the share that is not of the bottom
    float bottomless;       ///< of these, the texels that show water without a bottom
    float thinness;         ///< 1 / thickness of what stands there, 0 where nothing does
  };
  struct Scan;

  void survey(const Scan& scan, Executor& executor);
  bool find_standing(Size cells);
  bool is_shore(Size cells, int column, int row) const;
  bool fill(const Scan& scan, Executor& executor);
  bool find_end(Size cells, Executor& executor);
  template <class Fn>
  void each_near(Size size, int column, int row, Fn&& fn) const;
  float thinness_at(Size size, int column, int row) const;

  BottomLayer layer_;
  PullPush<4> bottom_;  ///< color and depth below the calm surface
  PullPush<1> end_;     ///< share of water without a bottom
  std::vector<Cell> cells_;
  std::vector<float> dilated_, closed_, room_;
  std::array<Plane, 6> planes_;  ///< color, depth below the calm surface, thinness, end_
};

}  // namespace limpid

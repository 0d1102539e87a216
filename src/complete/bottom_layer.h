#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "complete/pull_push.h"
#include "op/bottom_layer.h"
#include "op/pass.h"

namespace limpid {

/// Makes the layer of the bottom that refraction looks up for rays that go behind an object.
///
/// Works in cells of a few pixels; their number is about the same for any size of picture. A grey
/// closing of the depth below the water (Serra 1982, "Image Analysis and Mathematical Morphology"),
/// by windows of three cells to a quarter of the picture, fills the cells of objects that stand on
/// the bottom. The smallest window that fills an object gives its width, and a third of the width
/// counts as its thickness. Walls that lead down from an object are its feet, and no bottom. A
/// pyramid of means then extends the bottom over these cells and those of objects above the water,
/// and in the same way the share of water without a bottom.
class BottomLayerMaker {
 public:
  /// Null where no object stands in front of the bottom, no bottom is visible, or the eye is in the
  /// water. Made from color and depth even if the frame has a layer below the water: that layer is
  /// empty under land, and shows objects in the water as the picture does. Valid until the next
  /// call. The same for any number of threads. With `sun_over_rest` (SunShare) above 0, and
  /// with shadow, and sun_color if the frame has it, wherever color and depth are, its colors are
  /// those of a bottom that is all in the sun, for operators that find the shadows of hidden bottom
  /// themselves.
  const BottomLayer* make(const Frame& frame, const Pass& pass,
                          const std::array<double, 3>& sun_over_rest, Executor& executor);

 private:
  struct Cell {
    float highest;   ///< of its texels, as depth below the calm surface, 0 where one is above
    float nearness;  ///< 1 / eye depth there
    float width;     ///< of the cell there, in scene units
    float bottom;    ///< texels at this depth or deeper belong to the bottom
    int window;      ///< smallest window that fills the object, in cells; 0 without an object
    float looks, standing;  ///< number of lookups, and the share of them that show an object
    float bottomless;       ///< number of lookups that show water without a bottom
    float thinness;         ///< 1 / thickness of the object, 0 without an object
  };
  struct Scan;
  enum class Wall : std::uint8_t { kNone, kWall, kFoot };

  void survey(const Scan& scan, Executor& executor);
  bool find_standing(Size cells);
  void find_walls(const Scan& scan, Executor& executor);
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
  std::vector<Wall> walls_;
  std::vector<std::size_t> open_;  ///< cells whose neighbours are not looked at yet
  std::vector<float> dilated_, closed_, room_;
  std::array<Plane, 6> planes_;  ///< color, depth below the calm surface, thinness, end_
};

}  // namespace limpid

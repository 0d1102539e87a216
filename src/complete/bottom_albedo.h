#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "op/pass.h"

namespace limpid {

/// The albedo of what lies under the calm water, smooth: what a dry picture shows of it over what a
/// white level floor would show in the light that falls on it, sun (where `shadow` lets it) and
/// sky, each summed over some two depths of water around. As ratios of sums they stay right in
/// shadows and below 1 on walls; single pixels do not.
class BottomAlbedo {
 public:
  /// Looks at color, depth and, where it is there, shadow. `sky`: radiance of an even sky. 0 where
  /// there is no bottom near, or no light; at most 1 else.
  void make(const Frame& frame, const Pass& pass, const Rgb<double>& sky, Executor& executor);

  const Plane& channel(int i) const { return planes_[static_cast<std::size_t>(i)]; }

 private:
  static constexpr int kCell = 8;  ///< pixels a side

  /// Sums over a cell: color, light, and what tells how far to look around.
  struct Cell {
    std::array<float, 3> color{}, light{};
    float reach = 0, count = 0;
  };
  void gather(const Frame& frame, const Pass& pass, const Rgb<double>& sky, int row);
  int reach() const;
  void spread(int reach, Executor& executor);
  void draw_row(const Rect& window, int y);

  std::array<Plane, 3> planes_;
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> cells_, sums_;
};

}  // namespace limpid

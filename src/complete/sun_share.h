#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"

#include "op/pass.h"

namespace limpid {

/// The sun's light on sunlit bottoms of a frame over all other light there, of red, green, blue.
class SunShare {
 public:
  /// From color, sun_color, shadow and depth, every few pixels; at most 100. 0 where one of these
  /// planes is missing, no bottom is sunlit or all light is the sun's. The same for any number of
  /// threads.
  std::array<double, 3> over_rest(const Frame& frame, const Pass& pass, Executor& executor);

 private:
  struct Sums {
    std::array<double, 3> sun, rest;
  };
  std::vector<Sums> rows_;
};

}  // namespace limpid

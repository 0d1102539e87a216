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
  /// From color, sun_color, shadow and depth, every few pixels; at most 100. 0 where no bottom is
  /// sunlit or all light is the sun's, and without shadow. Without sun_color the median over the
  /// edges of shadows: the color of lit bottom over that of bottom in shadow, a 160th or an 80th of
  /// the picture away and at about the same depth, less 1; at most 20. With fewer than 32 such
  /// pairs it is `of_sky`, with 64 and more the median, a mix in between. The same for any number
  /// of threads.
  std::array<double, 3> over_rest(const Frame& frame, const Pass& pass,
                                  const std::array<double, 3>& of_sky, Executor& executor);

 private:
  struct Sums {
    std::array<double, 3> sun, rest;
  };
  std::array<double, 3> over_shadows(const Frame& frame, const Pass& pass,
                                     const std::array<double, 3>& of_sky, Executor& executor);
  std::vector<Sums> rows_;
  std::vector<std::vector<std::array<float, 3>>> edges_;  ///< the colors' quotients, per row
  std::vector<float> quotients_;
};

}  // namespace limpid

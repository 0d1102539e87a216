#pragma once
#include "judge/compare/color_grids.h"
#include "judge/compare/flip.h"

namespace limpid {

/// A picture as an observer sees it, for FLIP.
struct Seen {
  ColorGrid lab;       ///< L*, and a* and b* weighted by the lightness (Hunt)
  Grid<float> edges;   ///< strength
  Grid<float> points;  ///< strength
};

/// The visual filters for one observer.
class Eye {
 public:
  /// Throws Error for an invalid observer.
  explicit Eye(const Observer& observer);

  /// For a linear picture, 0 ... 1.
  Seen look_at(const ColorGrid& linear) const;

 private:
  // A Gaussian of the contrast sensitivity, and its weight in the channel.
  struct Blur {
    double share = 1;
    Kernel kernel;
  };
  Grid<float> blurred(const Grid<float>& channel, const std::vector<Blur>& blurs) const;

  std::array<std::vector<Blur>, 3> contrast_;
  Kernel smooth_, slope_, curve_;
};

/// L*, and a* and b* after Hunt, of a linear color.
std::array<double, 3> hunt_lab(const std::array<double, 3>& linear);

}  // namespace limpid

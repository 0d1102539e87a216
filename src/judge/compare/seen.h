#pragma once
#include "judge/compare/color_grids.h"
#include "judge/compare/flip.h"

namespace limpid {

/// What an observer sees of a picture, for FLIP.
struct Seen {
  ColorGrid lab;       ///< L*, and a* and b* that count by the lightness (Hunt)
  Grid<float> edges;   ///< strength
  Grid<float> points;  ///< strength
};

/// The eye: its filters, for one observer.
class Eye {
 public:
  /// Throws Error for an observer that cannot be.
  explicit Eye(const Observer& observer);

  /// Of a linear picture, 0 ... 1.
  Seen look_at(const ColorGrid& linear) const;

 private:
  // A Gaussian of the contrast sensitivity, and its share of the channel.
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

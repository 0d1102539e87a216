#pragma once
#include "limpid/core/frame.h"

#include "op/pass.h"
#include "op/pixel.h"

namespace limpid {

/// Searches for surfaces of the dry picture that hide the sun.
class SunSight {
 public:
  /// Keeps references to both. The pass must have a sun.
  SunSight(const View<const float>& depth, const Pass& pass) : depth_(depth), c_(pass) {}

  /// How much of the sun surfaces above the water hide from a point of the water, 0 ... 1: that at
  /// an eye depth on a pixel's ray.
  double hidden_from_water(int x, int y, double depth) const;
  /// How much of the sun all surfaces hide from a point of the dry picture, 0 or 1: that which a
  /// pixel shows.
  double hidden_from_surface(int x, int y) const;

 private:
  Pixel<double> pixel_at(int x, int y, double depth) const;

  const View<const float>& depth_;
  const Pass& c_;
};

}  // namespace limpid

#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "limpid/core/field.h"

namespace limpid {

/// Bounds for all wet pixels of an area, a cell or the whole picture, and for all texels that their
/// lookups may reach. Known before a pixel is computed, from the planes and from the operators, in
/// the order of the chain (Operator::bound in op/operator.h). All values lie inside these ranges,
/// often well inside. Views begin in the air.
///
/// The bounds on light hold for any set of operators that run. So a bound made of them stays valid
/// if another operator is left out, too.
struct Ranges {
  Range surface{0, HUGE_VAL};    ///< eye depth of the surface
  Range own{0, HUGE_VAL};        ///< eye depth of the dry scene at a pixel, less its surface's
  Range looked_up{0, HUGE_VAL};  ///< eye depth of all texels that refraction may look up
  double least_drop = 0;  ///< least depth below the calm surface of the bottom in the picture
  Range sink{-HUGE_VAL, HUGE_VAL};  ///< depth under the surface gained per unit of eye depth
  Range ray_length{1, HUGE_VAL};    ///< per unit of eye depth along the view
  std::array<Range, 3> color{
      {{-HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, HUGE_VAL}}};  ///< looked up
  Range shadow{0, 1};           ///< where lookups may end
  Range own_shadow{0, 1};       ///< on the surface, at the pixels themselves
  Range shadow_of_water{0, 1};  ///< on the surface, wherever sunlight enters, or at the pixels

  // Results of operators.
  Range hit{0, HUGE_VAL};       ///< eye depth of the lookup, less the surface's
  Range path{0, HUGE_VAL};      ///< of the refracted ray, as refraction leaves it
  Range fog_path{0, HUGE_VAL};  ///< the path along which fog dims the light
  double transmittance = 1;     ///< largest share of the looked-up light left by the fog
  double light = HUGE_VAL;      ///< largest |transmitted + in_scatter| of a channel
  double sun_light = 0;         ///< largest sunlit part of in_scatter
  double sun_far = 0;           ///< its part at the end of the path
  double above = 0;             ///< largest |reflected + highlight|
  double detail = 0;            ///< largest change of `light` by the albedo of the point looked up
  double focused = 0;           ///< largest change of the looked-up light by caustics
  double shafts = 0;            ///< largest change of the sunlit part of in_scatter by caustics

  /// cos of the angle between the view and the calm surface's normal.
  Range cosine() const {
    const double least = sink.min > 0 ? sink.min / ray_length.max : 0;
    return {std::min(least, 1.0), std::clamp(sink.max / ray_length.min, 0.0, 1.0)};
  }
  /// Largest difference of two looked-up values of one channel. Bilinear mixes of equal values may
  /// still differ by rounding.
  double contrast() const {
    double most = 0;
    for (const Range& c : color) most = std::max(most, c.max - c.min);
    return most + 1e-6 * brightest();
  }
  double brightest() const {
    double most = 0;
    for (const Range& c : color) most = std::max({most, -c.min, c.max});
    return most;
  }
};

/// a b, and 0 if one of them is, even if the other is infinite.
inline double bound_product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

}  // namespace limpid

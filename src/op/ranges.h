#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "limpid/core/field.h"

namespace limpid {

/// What holds for all wet pixels of a place, a cell of the picture or the whole of it, and for all
/// that their lookups may reach. Known before a pixel is computed, from the planes and from what
/// the operators make of them, in the order of the chain (see OperatorBounds). Nothing lies outside
/// these ranges; much may lie well inside. Views begin in the air.
///
/// The light below holds whichever operators run. So a bound made of it stays one when another
/// operator is left out, too.
struct Ranges {
  Range surface{0, HUGE_VAL};    ///< eye depth of the surface
  Range own{0, HUGE_VAL};        ///< eye depth of what lies under a pixel, less its surface's
  Range looked_up{0, HUGE_VAL};  ///< eye depth of all that refraction may look up
  double least_drop = 0;         ///< no bottom in the picture is less deep under the calm surface
  Range sink{-HUGE_VAL, HUGE_VAL};  ///< depth under the surface gained by a unit of eye depth
  Range ray_length{1, HUGE_VAL};    ///< of a unit of eye depth along the view
  std::array<Range, 3> color{
      {{-HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, HUGE_VAL}}};  ///< looked up
  Range shadow{0, 1};           ///< where lookups may end
  Range own_shadow{0, 1};       ///< on the surface, at the pixels themselves
  Range shadow_of_water{0, 1};  ///< on the surface, wherever sunlight enters, or at the pixels

  // What operators make of it.
  Range hit{0, HUGE_VAL};       ///< eye depth of what is seen, less the surface's
  Range path{0, HUGE_VAL};      ///< of the refracted ray, as refraction leaves it
  Range fog_path{0, HUGE_VAL};  ///< the path along which fog dims the light
  double transmittance = 1;     ///< largest share of what is looked up that is left by the fog
  double light = HUGE_VAL;      ///< largest |transmitted + in_scatter| of a channel
  double sun_light = 0;         ///< largest part of in_scatter that the sun lights
  double sun_far = 0;           ///< and of that, the part at the end of the path
  double above = 0;             ///< largest |reflected + highlight|
  double focused = 0;           ///< how much focused sunlight changes what is looked up, at most
  double shafts = 0;            ///< and what the sun lights of in_scatter

  /// cos of the angle between the view and the calm surface's normal.
  Range cosine() const {
    const double least = sink.min > 0 ? sink.min / ray_length.max : 0;
    return {std::min(least, 1.0), std::clamp(sink.max / ray_length.min, 0.0, 1.0)};
  }
  /// Largest difference of two looked-up values of one channel. Mixed from four texels, two that
  /// are equal may still differ by rounding.
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

/// a b, and 0 where one of them is, be the other infinite.
inline double bound_product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

}  // namespace limpid

#pragma once
#include <numbers>

#include "limpid/core/number.h"
#include "limpid/core/vec.h"

/// @file
/// Three facets that represent a pixel whose slopes along the view are Gaussian: a mean over the
/// slopes becomes a weighted mean over the three facets.

namespace limpid {

/// Leans are in standard deviations of the slope from the mean facet towards the view; shares sum
/// to 1.
template <class F>
struct ThreeFacets {
  F lean[3], share[3];
};

/// Integrals of z^n over z > 0, weighted by a Gaussian of deviation 1 around `mean`.
template <class F>
struct AboveZero {
  F of[5];

  LIMPID_INLINE explicit AboveZero(F mean) {
    // The Gaussian's tail, to 2e-4 of it: Abramowitz & Stegun 1964, "Handbook of Mathematical
    // Functions", 7.1.25.
    const F density = exp(F(-0.5) * mean * mean);
    const F t = F(1) / (F(1) + F(0.332672) * abs(mean));
    const F tail = density * t * (F(0.1740121) + t * (F(-0.0479399) + t * F(0.3739278)));
    of[0] = select(mean > F(0), F(1) - tail, tail);
    of[1] = mean * of[0] + F(0.39894228) * density;
    for (int n = 2; n < 5; ++n) of[n] = mean * of[n - 1] + F(n - 1) * of[n - 2];
  }
};

/// Facets of a plane with tilted normals, which hides no facet. A facet that would mirror rays into
/// the water mirrors along it: `level` is the distance from the mean facet to these facets. If few
/// facets are level, the nodes are those of Gauss and Hermite, else those of Gauss and Radau for
/// the slopes, with all level facets at one node: exact for polynomials up to the fourth degree in
/// both cases. Few means `level` above 2.3, where both rules nearly agree; values below -1.5 count
/// as -1.5.
template <class F>
LIMPID_INLINE ThreeFacets<F> plane_facets(F level) {
  constexpr double kFew = 2.3, kNode = std::numbers::sqrt3;
  const F a = min(max(level, F(-1.5)), F(kFew));
  const AboveZero<F> z(a);
  const F mean = z.of[2] / z.of[1], square = z.of[3] / z.of[1], cube = z.of[4] / z.of[1];
  const F variance = max(square - mean * mean, F(1e-4)), deviation = sqrt(variance);
  const F skew =
      F(0.5) * (cube - mean * (F(3) * square - F(2) * mean * mean)) / (variance * deviation);
  const F root = sqrt(F(1) + skew * skew);
  const F high = mean + deviation * (skew + root), low = mean + deviation * (skew - root);
  const F high_share = F(0.5) * z.of[1] * (F(1) - skew / root) / high;
  const F low_share = F(0.5) * z.of[1] * (F(1) + skew / root) / low;
  const auto few = level >= F(kFew);
  return {{select(few, F(0), low - level), select(few, F(kNode), high - level),
           select(few, F(-kNode), F(0) - level)},
          {select(few, F(2.0 / 3), low_share), select(few, F(1.0 / 6), high_share),
           select(few, F(1.0 / 6), F(1) - low_share - high_share)}};
}

/// Facets of a surface that waves raise: a facet counts by its area visible to the view. `facing`:
/// how the mean facet faces the view, which is the view's height over it for a unit along it, over
/// the deviation. Facets are visible where z > 0, the measure of how they face, with a Gaussian
/// around `facing`, whose moments are those of g = 1 / (facing + phi / Phi): the mean is facing +
/// g, the variance 2 - facing g - g^2. Smith 1967, "Geometrical Shadowing of a Random Rough
/// Surface". Below 0 the mean facet counts as one that the view grazes.
template <class F>
LIMPID_INLINE ThreeFacets<F> seen_facets(F facing) {
  const F a = max(facing, F(0)), near = min(a, F(8));
  const AboveZero<F> z(near);
  const F g = F(1) / (a + F(0.39894228) * exp(F(-0.5) * near * near) / z.of[0]);
  const F middle = g - min(facing, F(0));
  const F side = F(std::numbers::sqrt3) * sqrt(max(F(2) - a * g - g * g, F(0)));
  return {{middle, middle + side, middle - side}, {F(2.0 / 3), F(1.0 / 6), F(1.0 / 6)}};
}

/// A mirrored ray over water that waves raise.
template <class F>
struct NextMeeting {
  F share;  ///< of such rays, those that meet the waves again
  F rise;   ///< of these rays after the waves mirror them, per unit of level length
  F sine;   ///< of the mean angle between these rays and the waves that they meet
};

/// For a ray that rises by `rise` per unit of level length, over slopes of this deviation along the
/// ray; the view rises by `view`. The surface hides all rays below the horizon, and of the rays
/// above it the share of the masking and shadowing of Ross et al. 2005, "Detailed analytical
/// approach to the Gaussian surface bidirectional reflectance distribution function specular
/// component applied to the sea surface": a place that the view sees at a flat angle is high, and
/// few of its rays are hidden. The facets that hide them count by the area that they turn to the
/// ray, and mirror it up at least to the horizon. To first order in slopes, and with the same
/// deviation along the view. `deviation` above 0. The share is 0 of rays that rise more than
/// kHighest deviations: these meet the waves once in 7000 times.
template <class F>
LIMPID_INLINE NextMeeting<F> next_meeting(F rise, F view, F deviation) {
  constexpr double kHighest = 3, kLowest = -6, kFlattest = 1e-3;
  const F a = min(max(rise / deviation, F(kLowest)), F(kHighest));
  const F v = min(max(view / deviation, F(kFlattest)), F(kHighest));
  const AboveZero<F> passes(a), sees(v), meets(F(0) - a);
  const F above = max(a, F(0)), hidden = max(passes.of[1] - above, F(0));
  const F share = select(above > F(0), hidden / (hidden + above * sees.of[1] / v), F(1));
  const F facing = max(deviation * (meets.of[2] / meets.of[1]), F(0) - rise);
  return {select(a < F(kHighest), share, F(0)), rise + F(2) * facing, min(facing, F(1))};
}

/// The share of all facets that lean less towards the view than `lean`, of a plane.
template <class F>
LIMPID_INLINE F plane_share_under(F lean) {
  return AboveZero<F>(min(max(lean, F(-9)), F(9))).of[0];
}

/// The share of the facets of a surface raised by waves that lean less than `lean`, by visible
/// area: the integral of the density of seen_facets.
template <class F>
LIMPID_INLINE F seen_share_under(F facing, F lean) {
  const F a = min(max(facing, F(0)), F(8)), x = min(max(lean + min(facing, F(0)), F(0) - a), F(9));
  const AboveZero<F> least(F(0) - a), up_to(x), all(a);
  const auto density = [](F u) { return F(0.39894228) * exp(F(-0.5) * u * u); };
  const F area = a * (up_to.of[0] - least.of[0]) + density(a) - density(x);
  return saturate(area / all.of[1]);
}

/// For each of the three facets, the share (0 ... 1) of the facets that it represents that lies
/// under a limit; `under`: the share of all facets under that limit.
template <class F>
LIMPID_INLINE Vec3<F> parts_under(const ThreeFacets<F>& facets, F under) {
  const auto part = [&](int i, F above) {
    return saturate((under - above) / max(facets.share[i], F(1e-6)));
  };
  const F last = facets.share[2];
  return {part(0, last), part(1, last + facets.share[0]), part(2, F(0))};
}

}  // namespace limpid

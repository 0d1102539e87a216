#pragma once
#include <numbers>

#include "limpid/core/vec.h"

#include "optics/fresnel.h"

/// @file
/// Lobes of a sun highlight. All vectors unit: n the normal, v to the viewer, l to the light. The
/// Phong and Blinn-Phong lobes are 0 ... 1 and not physical: their energy grows with the width. The
/// GGX lobe is in 1/sr, to be multiplied by the sun's irradiance. A power is a number of the
/// formulas' type or, where all pixels share it, a double.

namespace limpid {

/// sat(R.V)^power with R the mirrored light direction. Phong 1975, "Illumination for Computer
/// Generated Pictures".
template <class F, class P>
LIMPID_INLINE F phong_lobe(Vec3<F> n, Vec3<F> v, Vec3<F> l, P power) {
  const Vec3<F> r = (F(2) * dot(n, l)) * n - l;
  return pow(saturate(dot(r, v)), power);
}

/// sat(N.H)^power with H half way between light and viewer; 0 where the two are opposite. Blinn
/// 1977, "Models of Light Reflection for Computer Synthesized Pictures".
template <class F>
LIMPID_INLINE F blinn_phong_lobe(Vec3<F> n, Vec3<F> v, Vec3<F> l, double power) {
  const Vec3<F> zero{F(0), F(0), F(0)};
  const Vec3<F> h = normalize_or(l + v, zero);
  return pow(saturate(dot(n, h)), power);
}

/// Density of facets whose normal is tilted from the mean normal by the angle with this squared
/// sine, in 1/sr: alpha^2 / (pi (sin^2 + alpha^2 cos^2)^2), for sin^2 0 ... 1. The sine keeps the
/// digits that a cosine near 1 has lost. `alpha` is the roughness, 1e-3 ... 1; slopes of variance s
/// along each axis are commonly given sqrt(2 s), as if they were Gaussian.
template <class F>
LIMPID_INLINE F ggx_distribution_of_sine(F sine_square, F alpha) {
  const F square = alpha * alpha;
  const F spread = sine_square + square * (F(1) - sine_square);
  return square / (F(std::numbers::pi) * spread * spread);
}

/// The same by the cosine N.H; 0 for facets that face away (N.H <= 0). Its integral times N.H over
/// the half sphere is 1. Walter et al. 2007, "Microfacet Models for Refraction through Rough
/// Surfaces". Its tails are longer than those of the sea's slopes, which are nearly Gaussian.
template <class F>
LIMPID_INLINE F ggx_distribution(F n_h, F alpha) {
  const F cosine = saturate(n_h);
  const F density = ggx_distribution_of_sine((F(1) - cosine) * (F(1) + cosine), alpha);
  return select(n_h > F(0), density, F(0));
}

/// Share of facets visible to both light and viewer, over 4 N.L N.V: the height-correlated form of
/// Smith's shadowing. Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based
/// BRDFs". Cosines below 1e-5 count as 1e-5, which keeps the result finite. Interreflection between
/// facets is left out: of a perfect mirror seen from straight above, 0.99 is left at alpha 0.1, 1 -
/// ln 2 at alpha 1.
template <class F>
LIMPID_INLINE F ggx_visibility(F n_v, F n_l, F alpha) {
  const F viewer = max(n_v, F(1e-5)), light = max(n_l, F(1e-5));
  const F square = alpha * alpha, rest = F(1) - square;
  return F(0.5) / (light * sqrt(viewer * viewer * rest + square) +
                   viewer * sqrt(light * light * rest + square));
}

/// ggx_distribution ggx_visibility sat(N.L): the lobe of a perfect reflector. 0 where N.L <= 0 and
/// where light and viewer are opposite. `alpha` below 1e-3 counts as 1e-3.
template <class F>
LIMPID_INLINE F ggx_mirror_lobe(Vec3<F> n, Vec3<F> v, Vec3<F> l, F alpha) {
  const Vec3<F> zero{F(0), F(0), F(0)};
  const F width = max(alpha, F(1e-3));
  const F n_l = dot(n, l);
  const Vec3<F> h = normalize_or(l + v, zero);
  const Vec3<F> lean = h - n;
  const F less = F(0.5) * dot(lean, lean);  // 1 - N.H
  const F density = ggx_distribution_of_sine(less * max(F(2) - less, F(0)), width);
  const F lobe = density * ggx_visibility(dot(n, v), n_l, width) * n_l;
  return select(n_l > F(0), select(dot(n, h) > F(0), lobe, F(0)), F(0));
}

/// Sunlight that a rough dielectric reflects: ggx_mirror_lobe fresnel_exact(L.H), in 1/sr, N.L
/// included. `ior` as for fresnel_exact.
template <class F>
LIMPID_INLINE F ggx_lobe(Vec3<F> n, Vec3<F> v, Vec3<F> l, F alpha, F ior) {
  const Vec3<F> zero{F(0), F(0), F(0)};
  return ggx_mirror_lobe(n, v, l, alpha) * fresnel_exact(dot(l, normalize_or(l + v, zero)), ior);
}

/// Solid angle of the sun's disc seen from the Earth, in sr: 0.2665 degrees of angular radius.
inline constexpr double kSunSolidAngle = 6.794e-5;

/// The kernel's peak over a disc's own radiance, 1 / (pi radius^2): a mirror image may not be
/// brighter than the disc itself.
inline constexpr double kBrightestLobe = 1.6 / std::numbers::pi;

/// ggx_lobe for the sun, no brighter than a mirror of that reflectance shows the disc itself: with
/// a sun as a point, the highlight on smooth water would be unbounded.
template <class F>
LIMPID_INLINE F sun_glint_lobe(Vec3<F> n, Vec3<F> v, Vec3<F> l, F alpha, F ior) {
  const Vec3<F> zero{F(0), F(0), F(0)};
  const F mirrored = min(ggx_mirror_lobe(n, v, l, alpha), F(1 / kSunSolidAngle));
  return mirrored * fresnel_exact(dot(l, normalize_or(l + v, zero)), ior);
}

/// The sun's disc in a perfect mirror of that reflectance: ggx_lobe of alpha 0, for a sun of the
/// size of ours. F / kSunSolidAngle where the mirrored view ends on the disc, else 0.
template <class F>
LIMPID_INLINE F sun_disc_lobe(Vec3<F> n, Vec3<F> v, Vec3<F> l, F ior) {
  // The chord from the disc's middle to its rim; angles this small are lost in a float's cosine.
  constexpr double kChord = 0.0046514;
  const F cosine = dot(n, v);
  const Vec3<F> off = (F(2) * cosine) * n - v - l;
  const auto hits = dot(off, off) < F(kChord * kChord) && cosine > F(0);
  return select(hits, F(1 / kSunSolidAngle) * fresnel_exact(cosine, ior), F(0));
}

/// Density of slopes at `off` from the mean slopes, for the covariance c, positive definite: 0
/// beyond sqrt(10) standard deviations. Kernel (k + 1) / (pi R^2 sqrt(det c)) (1 - d^2 / R^2)^k of
/// Mahalanobis' distance d, k = 3, R^2 = 2 (k + 2), whose covariance is c. The tails of a Gaussian
/// would be visible, because the sun is 1.5e4 times as bright as the surfaces that it lights.
template <class F>
LIMPID_INLINE F slope_density(Sym2<F> c, Vec2<F> off) {
  constexpr double kSquare = 10;
  // The determinant of the thinnest covariance that a float distinguishes from a line.
  const F det = max(c.xx * c.yy - c.xy * c.xy, F(1e-7) * c.xx * c.yy);
  const F square =
      (c.yy * off.x * off.x - F(2) * c.xy * off.x * off.y + c.xx * off.y * off.y) / det;
  const F inside = saturate(F(1) - F(1 / kSquare) * square);
  return F(4 / (std::numbers::pi * kSquare)) * inside * inside * inside / sqrt(det);
}

/// The sun's disc in water with waves, over its irradiance: the density of the slopes that mirror
/// it, over 4 h_z^4 and the visible projected area, times the reflectance (Ross et al. 2005,
/// "Detailed analytical approach to the Gaussian surface bidirectional reflectance distribution
/// function specular component applied to the sea surface"). In 1/sr. `up` is that of the calm
/// plane, n the mean normal, `spread` the covariance of the slopes along x and y, two axes of the
/// plane; `radius`, in rad, is that of the disc, which spreads the half vector's slope as well. The
/// visible area of slopes with that spread is m Phi(m/s) + s phi(m/s) with m = v.n / n.up and s
/// their deviation along the view (Bruneton et al. 2010, "Real-time Realistic Ocean Lighting using
/// Seamless Transitions from Geometry to BRDF"), here (m + sqrt(m^2 + 2 s^2 / pi)) / 2, which
/// differs by at most 5 % of s. 0 where the light or the half vector lies below the plane.
template <class F>
LIMPID_INLINE F wave_glint_lobe(Vec3<F> n, Vec3<F> v, Vec3<F> l, Vec3<F> up, Vec3<F> x, Vec3<F> y,
                                Sym2<F> spread, F radius, F ior) {
  const Vec3<F> zero{F(0), F(0), F(0)};
  const Vec3<F> sum = l + v;
  const F high = dot(sum, up);
  const auto above = high > F(1e-4) && dot(l, up) > F(0);
  const F per_high = F(-1) / select(above, high, F(1));
  const Vec2<F> slope{per_high * dot(sum, x), per_high * dot(sum, y)};
  const F lean = max(dot(n, up), F(0.05));
  const Vec2<F> off{slope.x + dot(n, x) / lean, slope.y + dot(n, y) / lean};
  // How the half vector's slope moves as the light moves over the disc.
  const F level = dot(l, up);
  const Vec2<F> turn{dot(l, x) + level * slope.x, dot(l, y) + level * slope.y};
  const F disc = F(0.25) * radius * radius * per_high * per_high;
  const Sym2<F> whole = spread + disc * Sym2<F>{F(1) + slope.x * slope.x - turn.x * turn.x,
                                                slope.x * slope.y - turn.x * turn.y,
                                                F(1) + slope.y * slope.y - turn.y * turn.y};
  const F m = dot(v, n) / lean, across_x = dot(v, x), across_y = dot(v, y);
  const F s_square = along(spread, Vec2<F>{across_x, across_y});
  const F area =
      F(0.5) * (m + sqrt(m * m + F(2 / std::numbers::pi) * max(s_square, F(0)) + F(1e-8)));
  const Vec3<F> half = normalize_or(sum, zero);
  const F cosine = dot(half, up);
  const F square = cosine * cosine;
  const F lobe = slope_density(whole, off) / (F(4) * max(square * square, F(1e-12)) * area);
  return select(above,
                min(lobe, F(kBrightestLobe) / (radius * radius)) * fresnel_exact(dot(l, half), ior),
                F(0));
}

}  // namespace limpid

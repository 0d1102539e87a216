#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "limpid/core/vec.h"

namespace limpid {

/// Weighted sums over pixels of one kind around a pixel, of colors less the pixel's own.
struct EdgeMoments {
  double weight = 0, alpha = 0;
  Rgb<double> color{0, 0, 0};
  std::array<double, 6> square{};  ///< rr rg rb gg gb bb

  static std::array<double, 6> products(const Rgb<double>& c) {
    return {c.r * c.r, c.r * c.g, c.r * c.b, c.g * c.g, c.g * c.b, c.b * c.b};
  }
  void add(double w, const Rgb<double>& c, double a) {
    weight += w;
    alpha += w * a;
    color = color + w * c;
    const std::array<double, 6> p = products(c);
    for (std::size_t i = 0; i < p.size(); ++i) square[i] += w * p[i];
  }
  friend EdgeMoments operator+(EdgeMoments a, const EdgeMoments& b);
  Rgb<double> mean() const { return (1 / weight) * color; }
};

/// Fits the inverse depth of a plane, which is linear on the screen.
struct EdgePlane {
  std::array<double, 6> place{};  ///< weighted sums of 1 x y xx xy yy
  std::array<double, 3> value{};  ///< weighted sums of the inverse depth times 1 x y
  double least = HUGE_VAL, most = 0;

  void add(double w, int right, int down, double inverse_depth) {
    const double x = right, y = down;
    const std::array<double, 6> at{1, x, y, x * x, x * y, y * y};
    for (std::size_t i = 0; i < at.size(); ++i) place[i] += w * at[i];
    for (std::size_t i = 0; i < value.size(); ++i) value[i] += w * inverse_depth * at[i];
    least = std::min(least, inverse_depth);
    most = std::max(most, inverse_depth);
  }
  /// The plane at the pixel (0, 0), by least squares, clamped to the depths seen.
  double here() const;
};

/// Kinds of the pixels around a pixel in the band of a blurred edge: dry in front of the pixel's
/// water, or wet; `sure` if beyond the band.
enum class EdgeKind : std::uint8_t { kDry, kWet, kSureDry, kSureWet };

/// The pixels around a pixel.
struct EdgeAround {
  std::array<EdgeMoments, 4> kinds;
  EdgeMoments& of(EdgeKind kind) { return kinds[static_cast<std::size_t>(kind)]; }
  const EdgeMoments& of(EdgeKind kind) const { return kinds[static_cast<std::size_t>(kind)]; }
};

struct Matte {
  double cover;  ///< share of the pixel that is dry, 0 ... 1
  /// The remaining light of the pixel, less the pixel's color.
  Rgb<double> behind;
};

/// The share of a pixel that an object in front of the water covers. Nothing if the pixel's color
/// does not determine it: one of the sides is missing, the two are alike, or the color is off the
/// line between them by more than half of their distance.
///
/// cover = d.(c - w) / d.(f - w), f and w the mean colors of the sure pixels, d = (S + e)^-1 (f -
/// w), S the covariance within the sides (Fisher 1936, "The Use of Multiple Measurements in
/// Taxonomic Problems"). Its standard deviation over texture is s = 1 / sqrt(d.(f - w)); (cover -
/// s) / (1 - 2 s) treats that as noise, and sides less than 3 s apart count as alike. The bottom's
/// texture in the pixel stays in `behind` by its share.
std::optional<Matte> matte_between(const EdgeAround& around);

/// The same for an object without sure pixels, thinner than its blur: the linear regression of
/// "dry" on color over all pixels. `behind` is the mean of the sure wet pixels, and of the light
/// that this mean and the object's color do not explain the part that may be the bottom's texture.
/// Nothing if the regression explains less than a quarter of the variance.
std::optional<Matte> matte_by_regression(const EdgeAround& around);
/// Whether the pixel's color, within three deviations, is one of the sure wet pixels'.
bool looks_wet(const EdgeAround& around, const Rgb<double>& color);
/// Whether the regression can succeed, by the weights alone.
bool may_regress(const EdgeAround& around);

}  // namespace limpid

#include "judge/compare/seen.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "limpid/core/error.h"

/// All formulas of this file come from Andersson et al. 2020 "FLIP: A Difference Evaluator for
/// Alternating Images".

namespace limpid {
namespace {

// In double, so that gray stays gray: its color is a difference of nearly equal numbers.
using Color = std::array<double, 3>;
using Matrix = std::array<Color, 3>;

constexpr double kPi = std::numbers::pi;

// X / Xn, Y / Yn and Z / Zn of linear sRGB: each row sums to 1, because white has no chroma.
constexpr Matrix kXyzOfRgb = [] {
  const double rows[3][3] = {{10135552, 8788810, 4435075},
                             {5226144, 17577620, 1774030},
                             {1425312 / 3.0, 8788810 / 3.0, 70074185 / 3.0}};
  Matrix m{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double white = rows[i][0] + rows[i][1] + rows[i][2];
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = rows[i][j] / white;
  }
  return m;
}();

// Its inverse, by cofactors.
constexpr Matrix kRgbOfXyz = [] {
  const Matrix& m = kXyzOfRgb;
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
    return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
  };
  const double determinant =
      m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Matrix inverse{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) inverse[j][i] = cofactor(i, j) / determinant;
  }
  return inverse;
}();

Color times(const Matrix& m, const Color& c) {
  const auto row = [&](std::size_t i) { return m[i][0] * c[0] + m[i][1] * c[1] + m[i][2] * c[2]; };
  return {row(0), row(1), row(2)};
}

Color at(const ColorGrid& grid, std::size_t i) { return {grid[0][i], grid[1][i], grid[2][i]}; }

void put(ColorGrid& grid, std::size_t i, const Color& color) {
  for (std::size_t c = 0; c < 3; ++c) grid[c][i] = static_cast<float>(color[c]);
}

// YCxCz, a linear form of L*a*b*: Y, then X - Y and Y - Z, each over white. The paper's scales
// (116, 500, 200) and the offset of Y cancel in the inverse, because filters are linear.
Color opponent(const Color& linear) {
  const auto [x, y, z] = times(kXyzOfRgb, linear);
  return {y, x - y, y - z};
}

Color linear_from_opponent(const Color& o) {
  Color linear = times(kRgbOfXyz, {o[0] + o[1], o[0], o[0] - o[2]});
  for (double& v : linear) v = std::clamp(v, 0.0, 1.0);
  return linear;
}

double lab_curve(double t) {
  constexpr double kKnee = 6.0 / 29;
  return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3 * kKnee * kKnee) + 4.0 / 29;
}

// Contrast sensitivity a exp(-b f^2) for f cycles per degree; as a filter, a sqrt(pi / b) exp(-(pi
// x)^2 / b) at x degrees.
struct Sensitivity {
  double a, b;
};
const std::array<std::vector<Sensitivity>, 3> kSensitivities = {
    {{{1, 0.0047}}, {{1, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}}};
constexpr double kWidest = 0.04;

constexpr double kFeatureDegrees = 0.082;  // width of an edge or a point

double sum(const Kernel& kernel) {
  double total = 0;
  for (const double k : kernel) total += k;
  return total;
}

Grid<float> length(const Grid<double>& x, const Grid<double>& y) {
  Grid<float> result(x.size());
  for (std::size_t i = 0; i < result.count(); ++i) {
    result[i] = static_cast<float>(std::sqrt(x[i] * x[i] + y[i] * y[i]));
  }
  return result;
}

}  // namespace

std::array<double, 3> hunt_lab(const std::array<double, 3>& linear) {
  auto [x, y, z] = times(kXyzOfRgb, linear);
  x = lab_curve(x), y = lab_curve(y), z = lab_curve(z);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

Eye::Eye(const Observer& observer) {
  const double ppd = observer.pixels_per_degree;
  if (!(ppd >= 1 && ppd <= 1000)) {
    throw Error("flip: " + std::to_string(ppd) + " pixels a degree: expected 1 ... 1000");
  }
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * ppd));
  for (std::size_t c = 0; c < 3; ++c) {
    double total = 0;
    for (const auto& [a, b] : kSensitivities[c]) {
      const Kernel kernel = bell(radius, std::sqrt(b / 2) / kPi * ppd);
      const double weight = a * std::sqrt(kPi / b) * sum(kernel) * sum(kernel);
      contrast_[c].push_back({weight, normalized(kernel)});
      total += weight;
    }
    for (Blur& blur : contrast_[c]) blur.share /= total;
  }

  const double sigma = 0.5 * kFeatureDegrees * ppd;
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  smooth_ = slope_ = curve_ = bell(reach, sigma);
  for (int i = -reach; i <= reach; ++i) {
    const auto k = static_cast<std::size_t>(i + reach);
    slope_[k] *= -i;
    curve_[k] *= (i / sigma) * (i / sigma) - 1;
  }
  for (Kernel* kernel : {&smooth_, &slope_, &curve_}) *kernel = normalized(*kernel);
}

Grid<float> Eye::blurred(const Grid<float>& channel, const std::vector<Blur>& blurs) const {
  if (blurs.size() == 1) return filtered(channel, blurs[0].kernel, blurs[0].kernel);
  Grid<float> result(channel.size());
  for (const Blur& blur : blurs) {
    const Grid<float> part = filtered(channel, blur.kernel, blur.kernel);
    const auto share = static_cast<float>(blur.share);
    for (std::size_t i = 0; i < result.count(); ++i) result[i] += share * part[i];
  }
  return result;
}

Seen Eye::look_at(const ColorGrid& linear) const {
  ColorGrid color = linear;
  // In double, because the later square root of feature differences would amplify the rounding
  // error that float leaves in a uniform picture.
  Grid<double> gray(linear[0].size());
  for (std::size_t i = 0; i < gray.count(); ++i) {
    const Color here = opponent(at(linear, i));
    put(color, i, here);
    gray[i] = here[0];
  }
  Grid<float> edges = length(filtered(gray, slope_, smooth_), filtered(gray, smooth_, slope_));
  Grid<float> points = length(filtered(gray, curve_, smooth_), filtered(gray, smooth_, curve_));

  for (std::size_t c = 0; c < 3; ++c) color[c] = blurred(color[c], contrast_[c]);
  for (std::size_t i = 0; i < gray.count(); ++i) {
    put(color, i, hunt_lab(linear_from_opponent(at(color, i))));
  }
  return {std::move(color), std::move(edges), std::move(points)};
}

}  // namespace limpid

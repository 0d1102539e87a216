#include "judge/compare/ssim.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "limpid/core/error.h"
#include "limpid/files/picture/preview.h"

#include "judge/compare/color_grids.h"
#include "judge/compare/number_text.h"

namespace limpid {
namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

Grid<double> shown_luminance(const ColorGrid& color) {
  Grid<double> result(color[0].size());
  for (std::size_t i = 0; i < result.count(); ++i) {
    const double linear = luminance(color[0][i], color[1][i], color[2][i]);
    result[i] = srgb_from_linear(static_cast<float>(std::clamp(linear, 0.0, 1.0)));
  }
  return result;
}

Grid<double> product(const Grid<double>& a, const Grid<double>& b) {
  Grid<double> result(a.size());
  for (std::size_t i = 0; i < result.count(); ++i) result[i] = a[i] * b[i];
  return result;
}

void check_size(Size size) {
  constexpr int kLeast = 2 * kRadius + 1;
  if (size.width >= kLeast && size.height >= kLeast) return;
  throw Error("SSIM of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
              " pixels: expected at least " + std::to_string(kLeast) + "x" +
              std::to_string(kLeast));
}

Ssim compared(const Grid<double>& a, const Grid<double>& b, const CleanPair& pictures) {
  const Kernel window = normalized(bell(kRadius, kSigma));
  const auto local = [&](const Grid<double>& grid) { return filtered(grid, window, window); };
  const Grid<double> mean_a = local(a), mean_b = local(b);
  const Grid<double> aa = local(product(a, a)), bb = local(product(b, b)),
                     ab = local(product(a, b));
  Ssim result;
  result.map = Plane(pictures.window);
  result.min = std::numeric_limits<double>::infinity();
  const Size size = a.size();
  double sum = 0;
  std::size_t i = 0;
  for (int y = 0; y < size.height; ++y) {
    float* row = result.map.view().row(pictures.window.y0 + y);
    for (int x = 0; x < size.width; ++x, ++i) {
      const double m = mean_a[i] * mean_b[i], mm = mean_a[i] * mean_a[i] + mean_b[i] * mean_b[i];
      const double covariance = ab[i] - m, variances = aa[i] + bb[i] - mm;
      const double value =
          (2 * m + kC1) * (2 * covariance + kC2) / ((mm + kC1) * (variances + kC2));
      row[x] = static_cast<float>(value);
      if (pictures.mismatched[i]) {
        ++result.mismatches;
        row[x] = -std::numeric_limits<float>::infinity();
      }
      if (std::min(x, y) < kRadius || x >= size.width - kRadius || y >= size.height - kRadius) {
        continue;
      }
      sum += value;
      result.min = std::min<double>(result.min, row[x]);
    }
  }
  result.mean = sum / (double(size.width - 2 * kRadius) * (size.height - 2 * kRadius));
  if (result.mismatches > 0) result.mean = -std::numeric_limits<double>::infinity();
  return result;
}

}  // namespace

Ssim ssim(View<const float> a, View<const float> b) {
  const CleanPair pictures = clean({{a, a, a}, {b, b, b}});
  check_size(pictures.window.size());
  const auto widened = [](const Grid<float>& grid) {
    Grid<double> result(grid.size());
    for (std::size_t i = 0; i < result.count(); ++i) result[i] = grid[i];
    return result;
  };
  return compared(widened(pictures.a[0]), widened(pictures.b[0]), pictures);
}

Ssim ssim(const ColorPair& pictures) {
  const CleanPair pair = clean(pictures);
  check_size(pair.window.size());
  return compared(shown_luminance(pair.a), shown_luminance(pair.b), pair);
}

std::string to_text(const Ssim& ssim) {
  return number_text(ssim.mean) + ", min " + number_text(ssim.min);
}

}  // namespace limpid

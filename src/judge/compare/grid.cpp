#include "judge/compare/grid.h"

#include <algorithm>
#include <cmath>

namespace limpid {
namespace {

template <class T>
void add_scaled(const T* values, T by, T* sum, int count) {
  for (int i = 0; i < count; ++i) sum[i] += by * values[i];
}

template <class T>
Grid<T> filter(const Grid<T>& grid, const Kernel& across, const Kernel& down) {
  const auto [width, height] = grid.size();
  const int left = static_cast<int>(across.size() / 2), above = static_cast<int>(down.size() / 2);
  Grid<T> rows(grid.size()), result(grid.size());
  if (grid.count() == 0) return result;
  std::vector<T> row(width + across.size());  // padded by repeating its ends
  for (int y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < row.size(); ++x) {
      row[x] = grid.row(y)[std::clamp(static_cast<int>(x) - left, 0, width - 1)];
    }
    for (std::size_t k = 0; k < across.size(); ++k) {
      add_scaled(row.data() + k, static_cast<T>(across[k]), rows.row(y), width);
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int k = 0; k < static_cast<int>(down.size()); ++k) {
      add_scaled(rows.row(std::clamp(y + k - above, 0, height - 1)), static_cast<T>(down[k]),
                 result.row(y), width);
    }
  }
  return result;
}

}  // namespace

Grid<float> filtered(const Grid<float>& grid, const Kernel& across, const Kernel& down) {
  return filter(grid, across, down);
}

Grid<double> filtered(const Grid<double>& grid, const Kernel& across, const Kernel& down) {
  return filter(grid, across, down);
}

Kernel bell(int radius, double sigma) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) {
    kernel.push_back(std::exp(-0.5 * (i / sigma) * (i / sigma)));
  }
  return kernel;
}

Kernel normalized(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const double k : kernel) (k > 0 ? positive : negative) += std::abs(k);
  for (double& k : kernel) k /= k > 0 ? positive : (negative > 0 ? negative : 1);
  return kernel;
}

}  // namespace limpid

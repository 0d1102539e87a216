#include "judge/compare/grid.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

namespace limpid {
namespace {

template <class T>
Grid<T> filter(const Grid<T>& grid, const Kernel& across, const Kernel& down) {
  const std::vector<T> x(across.begin(), across.end()), y(down.begin(), down.end());
  Grid<T> result(grid.size());
  cv::sepFilter2D(grid.mat(), result.mat(), -1, x, y, {-1, -1}, 0, cv::BORDER_REPLICATE);
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

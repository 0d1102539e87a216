#pragma once
#include <cstddef>
#include <vector>

#include "limpid/core/rect.h"

namespace limpid {

/// A plane of numbers in rows without gaps.
template <class T>
class Grid {
 public:
  explicit Grid(Size size)
      : size_(size), values_(static_cast<std::size_t>(size.width) * size.height) {}

  Size size() const { return size_; }
  std::size_t count() const { return values_.size(); }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }

  T* row(int y) { return values_.data() + static_cast<std::size_t>(y) * size_.width; }
  const T* row(int y) const { return values_.data() + static_cast<std::size_t>(y) * size_.width; }

 private:
  Size size_;
  std::vector<T> values_;
};

/// Numbers at -radius ... radius.
using Kernel = std::vector<double>;

/// Correlates rows with `across` and columns with `down`; beyond its sides the grid repeats its
/// edge. Runs on the caller's thread.
Grid<float> filtered(const Grid<float>& grid, const Kernel& across, const Kernel& down);
Grid<double> filtered(const Grid<double>& grid, const Kernel& across, const Kernel& down);

/// exp(-(i / sigma)^2 / 2) at i = -radius ... radius.
Kernel bell(int radius, double sigma);
/// Scaled so that the positive numbers sum to 1, and the negative ones, if there are any, to -1.
Kernel normalized(Kernel kernel);

}  // namespace limpid

#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace limpid {

/// The combination of N functions nearest to given values, by the sum of squares. Components that
/// the values do not determine stay small.
template <std::size_t N>
class LeastSquares {
 public:
  using Row = std::array<double, N>;

  /// `least`: weight of a measurement of 0 for each coefficient, over the function's own square. A
  /// larger weight keeps coefficients small whose functions cancel each other (Tikhonov).
  explicit LeastSquares(double least = 1e-13) : least_(least) {}

  /// One equation: the functions' values, and the value of their combination.
  void add(const Row& functions, double value) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j <= i; ++j) products_[i][j] += functions[i] * functions[j];
      values_[i] += functions[i] * value;
    }
  }

  /// The coefficient of each function. By Cholesky's factors of the normal equations.
  Row solved() const {
    std::array<std::array<double, N>, N> factor{};
    std::array<double, N> x{};
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = products_[i][j];
        for (std::size_t k = 0; k < j; ++k) sum -= factor[i][k] * factor[j][k];
        if (i != j) {
          factor[i][j] = sum / factor[j][j];
        } else {
          const double least = least_ * products_[i][i] + 1e-300;
          factor[i][i] = std::sqrt(std::max(sum, 0.0) + least);
        }
      }
      x[i] = values_[i];
      for (std::size_t k = 0; k < i; ++k) x[i] -= factor[i][k] * x[k];
      x[i] /= factor[i][i];
    }
    Row solution;
    for (std::size_t i = N; i-- > 0;) {
      for (std::size_t k = i + 1; k < N; ++k) x[i] -= factor[k][i] * x[k];
      x[i] /= factor[i][i];
      solution[i] = static_cast<double>(x[i]);
    }
    return solution;
  }

 private:
  std::array<std::array<double, N>, N> products_{};
  std::array<double, N> values_{};
  double least_;
};

}  // namespace limpid

#pragma once
#include <algorithm>
#include <cmath>

#include "limpid/core/vec.h"

namespace limpid::trace {

/// The mean of many random lights, and its standard error. Welford 1962, "Note on a Method for
/// Calculating Corrected Sums of Squares and Products".
class MeanLight {
 public:
  void add(const Rgb<double>& light) {
    count_ += 1;
    const Rgb<double> off = light - mean_;
    mean_ = mean_ + (1 / count_) * off;
    squares_ = squares_ + off * (light - mean_);
  }

  const Rgb<double>& mean() const { return mean_; }

  /// Standard error; 0 for fewer than two.
  Rgb<double> error() const {
    if (count_ < 2) return {0, 0, 0};
    const auto root = [this](double squares) {
      return std::sqrt(std::max(squares, 0.0) / (count_ - 1) / count_);
    };
    return {root(squares_.r), root(squares_.g), root(squares_.b)};
  }

 private:
  double count_ = 0;
  Rgb<double> mean_{0, 0, 0}, squares_{0, 0, 0};
};

}  // namespace limpid::trace

#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "judge/hard/world.h"

namespace limpid {

/// Half an ulp of 1: the largest relative error of rounding to float.
inline constexpr double kRounding = 0x1p-24;

/// The largest measured value of a case, and its place. NaN counts as infinite.
class Worst {
 public:
  /// `where`, a callable, is called only for a new maximum.
  template <class Where>
  void add(double value, Where&& where) {
    ++count_;
    if (std::isnan(value)) value = std::numeric_limits<double>::infinity();
    if (value <= value_) return;
    value_ = value;
    where_ = where();
  }
  void add_counts(const Worst& other) {
    count_ += other.count_;
    if (value_ == 0) where_ = other.where_;
    value_ += other.value_;
  }
  /// Counts violations. Not together with add().
  template <class Where>
  void expect(bool holds, Where&& where) {
    ++count_;
    if (holds) return;
    if (value_ == 0) where_ = where();
    value_ += 1;
  }
  double value() const { return value_; }
  std::int64_t count() const { return count_; }
  const std::string& where() const { return where_; }

 private:
  double value_ = 0;
  std::int64_t count_ = 0;
  std::string where_;
};

struct HardCase {
  std::string group, name;
  std::string quantity, reason;
  double bound;
  std::function<Worst(const HardWorld&)> measure;
};

using HardCases = std::vector<HardCase>;

/// Counts invalid values in all pictures of a frame by a look and a runner: NaN in AOVs, NaN or inf
/// in the picture.
Worst unsound_values(const HardWorld& world, const HardFrame& frame, const Scene& scene);

/// One function per file, in the order of the table.
void add_depth_cases(HardCases& cases);
void add_camera_cases(HardCases& cases);
void add_angle_cases(HardCases& cases);
void add_projection_cases(HardCases& cases);
void add_scale_cases(HardCases& cases);
void add_shore_cases(HardCases& cases);
void add_sky_cases(HardCases& cases);
void add_pixel_cases(HardCases& cases);
void add_normal_cases(HardCases& cases);
void add_power_cases(HardCases& cases);
void add_time_cases(HardCases& cases);
void add_lookup_cases(HardCases& cases);
void add_size_cases(HardCases& cases);

/// All cases, in the order of the functions above.
HardCases hard_cases();

}  // namespace limpid

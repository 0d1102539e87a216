#pragma once
#include <string>
#include <vector>

namespace limpid {

/// A line of the grid.
struct Tick {
  double value = 0;
  std::string label;  ///< "" for a line without a number
};

/// A logarithmic axis from 1, 2 or 5 times a power of ten to another such number, with all values
/// and some air between them.
class LogAxis {
 public:
  /// Throws Error unless 0 < least <= most, both finite.
  LogAxis(double least, double most);

  double first() const { return ticks_.front().value; }
  double last() const { return ticks_.back().value; }
  /// 0 at first(), 1 at last().
  double place(double value) const;
  /// Every 1 ... 9 times a power of ten. Numbers stand at powers of ten; at 2 and 5 times one, too,
  /// where there are less than three decades.
  const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  std::vector<Tick> ticks_;
};

}  // namespace limpid

#pragma once
#include <string>

#include "limpid/core/rect.h"
#include "limpid/files/limits.h"

namespace limpid {

/// Keeps the planes of one frame within the limits, over all its files.
class PlaneBudget {
 public:
  explicit PlaneBudget(const Limits& limits) : limits_(limits) {}

  /// The window of a plane that holds both. Throws Error, which begins with `name`, if that window
  /// or the sum of all planes so far is over a limit.
  Rect take(const std::string& name, const Rect& data, const Rect& picture);

 private:
  Limits limits_;
  std::int64_t bytes_ = 0;
};

}  // namespace limpid

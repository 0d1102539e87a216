#pragma once
#include <string>

#include "limpid/core/rect.h"
#include "limpid/files/limits.h"

namespace limpid {

/// Keeps the planes of one frame within the limits, whatever files they come from.
class PlaneBudget {
 public:
  explicit PlaneBudget(const Limits& limits) : limits_(limits) {}

  /// The window of a plane that holds both. Throws Error, which begins with `name`, when they lie
  /// so far apart that it is over a limit, or when all planes so far are.
  Rect take(const std::string& name, const Rect& data, const Rect& picture);

 private:
  Limits limits_;
  std::int64_t bytes_ = 0;
};

}  // namespace limpid

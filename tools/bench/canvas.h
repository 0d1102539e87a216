#pragma once
#include <vector>

#include "limpid/core/plane.h"
#include "limpid/run/target.h"

namespace limpid::bench {

/// A target that owns its planes: color and alpha, no AOVs.
struct Canvas {
  explicit Canvas(Rect window) {
    for (int i = 0; i < 4; ++i) planes.emplace_back(window);
    for (int i = 0; i < 3; ++i) target.color[i] = planes[i].view();
    target.alpha = planes[3].view();
  }
  std::vector<Plane> planes;
  Target target;
};

}  // namespace limpid::bench

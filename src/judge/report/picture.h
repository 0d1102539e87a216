#pragma once
#include <array>
#include <vector>

#include "limpid/core/plane.h"
#include "limpid/run/target.h"

namespace limpid {

/// A target that owns its planes: color and alpha, no AOVs.
struct Picture {
  explicit Picture(Rect window) {
    for (int i = 0; i < 4; ++i) planes.emplace_back(window);
    for (int i = 0; i < 3; ++i) target.color[i] = planes[i].view();
    target.alpha = planes[3].view();
  }
  std::array<View<const float>, 3> color() const {
    return {planes[0].view(), planes[1].view(), planes[2].view()};
  }

  std::vector<Plane> planes;
  Target target;
};

}  // namespace limpid

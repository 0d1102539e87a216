#pragma once
#include "op/caustics_table.h"
#include "support.h"

namespace limpid::test {

/// Light of 0 ... 3, or slightly below 0 as in a sharpened table, in two levels around the eye; the
/// same light in the water.
struct NoiseCaustics {
  NoiseCaustics() {
    table.count = 2;
    table.least = -0.1, table.most = 3;
    table.slopes = 1;
    for (int i = 0; i < 2; ++i) {
      Plane& plane = i == 0 ? fine : coarse;
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 50; ++x) plane.view().at(x, y) = 3.1f * noise(x, y, 60 + i) - 0.1f;
      }
      const double texel = 0.25 * (i + 1);
      table.levels[static_cast<std::size_t>(i)] = {plane.view(), {-25 * texel, -20 * texel}, texel};
    }
    water = table;
    water.depth = 0.5;
    water.first = CausticsTable::kMaxLevels;
    table.in_water = &water;
  }
  NoiseCaustics(const NoiseCaustics&) = delete;
  NoiseCaustics& operator=(const NoiseCaustics&) = delete;
  Plane fine{rect_of({50, 40})}, coarse{rect_of({50, 40})};
  CausticsTable table, water;
};

}  // namespace limpid::test

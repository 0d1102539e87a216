#pragma once
#include "op/pass.h"
#include "plan/patchy_frame.h"

/// Water over a mostly smooth bottom for marches, which noise would end at once.

namespace limpid::test {

enum class Below { kNone, kWhole, kHoles, kEmpty };

/// Deep and shallow patches, slopes between them, rocks below and above the water, a far shore and
/// sky; a larger data window (overscan) now and then, waves in the plane of the surface.
inline Buffers landscape(Rect display, const Scene& scene, int seed, bool surface, Below below) {
  Buffers b(display);
  const int more = seed % 3 == 0 ? 21 : 0;
  const Rect data{display.x0 - more, display.y0 - more, display.x1 + more, display.y1 + more};
  const Pass pass(scene, b.frame, 1.333, {});
  const auto calm = [&](int x, int y) {
    const RowRays<double> rays(pass, y - pass.corner.y + 0.5);
    return rays.calm_depth(x - pass.corner.x + 0.5);
  };
  const double deep = 0.5 + 3 * noise(seed, 0, 50), rough = noise(seed, 1, 50);
  const auto rock = [&](int x, int y) { return patch(x, 2 * y, seed + 1); };
  const auto bottom = [&](int x, int y) {
    const double slope = 1 + 0.5 * std::sin(0.013 * x + seed) * std::sin(0.021 * y);
    const double drop = deep * slope + 0.1 * rough * noise(x, y, seed);
    return calm(x, y) * (1 + drop * (rock(x, y) < 0.2f ? 0.3 : 1) / pass.eye_above);
  };
  const auto far = [&](int x, int y) { return y % 40 < 20 || x % 90 < 30 ? kInf : 300.0f; };
  for (int c = 0; c < 3; ++c) {
    const auto color = [&](int x, int y) { return noise(x, y, seed + 60 + c); };
    b.set(plane_after(PlaneId::kColorR, c), color, data);
    b.set(plane_after(PlaneId::kReflectionR, c), color, data);
    if (below != Below::kNone) b.set(plane_after(PlaneId::kBelowR, c), color, data);
  }
  const bool rocks = below != Below::kEmpty;
  b.set(
      PlaneId::kDepth,
      [&](int x, int y) {
        const double water = calm(x, y);
        if (!(water < 1e4)) return far(x, y);
        if (rocks && rock(x, y) > 0.85f) return static_cast<float>(0.9 * water);
        return below == Below::kEmpty ? kInf : static_cast<float>(bottom(x, y));
      },
      data);
  if (surface) {
    b.set(
        PlaneId::kSurfaceDepth,
        [&](int x, int y) {
          const double wave = 0.02 * std::sin(0.3 * x + 0.1 * y);
          return static_cast<float>(calm(x, y) * (1 + wave / pass.eye_above));
        },
        data);
  }
  if (below != Below::kNone) {
    b.set(
        PlaneId::kBelowDepth,
        [&](int x, int y) {
          const bool hole = below == Below::kHoles && patch(x, y, seed + 2) < 0.3f;
          if (hole || below == Below::kEmpty || !(calm(x, y) < 1e4)) return kInf;
          return static_cast<float>(bottom(x, y));
        },
        data);
  }
  return b;
}

}  // namespace limpid::test

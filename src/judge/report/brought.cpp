#include "judge/report/brought.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "op/footprint.h"
#include "op/pass.h"
#include "op/pixel_start.h"

namespace limpid {
namespace {

const PlaneSet kSteps[] = {
    kColorPlanes | PlaneSet{PlaneId::kColorA, PlaneId::kDepth},
    PlaneSet{PlaneId::kShadow} | kSunColorPlanes,
    kReflectionPlanes,
    {PlaneId::kReflectionDepth, PlaneId::kReflectionValid},
    kSurfaceNormalPlanes | kBelowPlanes | PlaneSet{PlaneId::kSurfaceDepth, PlaneId::kSurfaceShadow},
};

/// Sums over waves, or over a map.
struct Squares {
  double slope = 0, curvature = 0;
  double length() const { return 2 * std::numbers::pi * std::sqrt(slope / curvature); }
};

double square(Vec2<double> v) { return v.x * v.x + v.y * v.y; }

/// Downhill slope between texels; the map wraps around.
Vec2<double> slope_at(const Texture& map, int x, int y) {
  const Rect& w = map.channels[0].window;
  const auto value = [&](int c) {
    return 2.0 * map.channels[c].at(w.x0 + x % w.width(), w.y0 + y % w.height()) - 1;
  };
  const double up = std::max(value(2), 0.05);
  return {value(0) / up, value(1) / up};
}

}  // namespace

std::vector<Brought> brought_one_by_one(PlaneSet planes) {
  std::vector<Brought> list;
  PlaneSet all;
  for (const PlaneSet step : kSteps) {
    const PlaneSet added = step & planes;
    if (added.empty()) continue;
    all = all | added;
    list.push_back({added, all});
  }
  return list;
}

double wave_length(std::span<const SineWave> waves) {
  Squares sum;
  for (const SineWave& wave : waves) {
    const double k2 = wave.k_x * wave.k_x + wave.k_y * wave.k_y;
    const double slope = wave.amplitude * wave.amplitude * k2;
    sum.slope += slope;
    sum.curvature += slope * k2;
  }
  return sum.length();
}

double wave_length(const Texture& map, double tile_size) {
  const Rect& w = map.channels[0].window;
  const double per_x = w.width() / tile_size, per_y = w.height() / tile_size;
  Squares sum;
  for (int y = 0; y < w.height(); ++y) {
    for (int x = 0; x < w.width(); ++x) {
      const Vec2<double> s = slope_at(map, x, y);
      const Vec2<double> dx = per_x * (slope_at(map, x + 1, y) - s);
      const Vec2<double> dy = per_y * (slope_at(map, x, y + 1) - s);
      sum.slope += square(s);
      sum.curvature += square(dx) + square(dy);
    }
  }
  return sum.length();
}

std::vector<Place> places_of(const Scene& scene, const Frame& frame, double near,
                             const std::function<bool(int x, int y)>& wet) {
  const WaterView view(scene, frame.display, swell_of(frame));
  const Rect w = frame.work();
  std::vector<Place> places;
  for (int y = w.y0; y < w.y1; ++y) {
    const RowRays<double> row(view, y - view.corner.y + 0.5);
    for (int x = w.x0; x < w.x1; ++x) {
      if (!wet(x, y)) {
        places.push_back(Place::kDry);
        continue;
      }
      const double column = x - view.corner.x + 0.5, depth = row.calm_depth(column);
      bool is_near = begins_in_water(view, row, column) > 0;
      if (std::isfinite(depth)) {
        Pixel<double> pixel{};
        begin_pixel(view, row, column, 1.0, depth, depth, pixel);
        is_near = !(texels_wide(footprint(view, pixel), {1, 1}, 1) >= near);
      }
      places.push_back(is_near ? Place::kNear : Place::kFar);
    }
  }
  return places;
}

}  // namespace limpid

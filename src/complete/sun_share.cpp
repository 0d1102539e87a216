#include "complete/sun_share.h"

#include <algorithm>

#include "complete/row_heights.h"
#include "complete/rows.h"

namespace limpid {
namespace {

constexpr int kLooks = 160;      ///< along the longer side of the picture
constexpr double kMaxSun = 100;  ///< over the rest of the light, where that is almost nothing
constexpr float kLit = 0.95f;

}  // namespace

std::array<double, 3> SunShare::over_rest(const Frame& frame, const Pass& c, Executor& executor) {
  if (!c.planes.covers(kSunColorPlanes | PlaneSet{PlaneId::kShadow})) return {};
  const Rect work = frame.work();
  const int step = std::max(4, std::max(work.width(), work.height()) / kLooks);
  const int rows = (work.height() + step - 1) / step;
  rows_.resize(static_cast<std::size_t>(rows));
  each_row(executor, {0, 0, 1, rows}, [&](int row) {
    const int y = work.y0 + row * step;
    const RowHeights heights(c, y);
    Sums& sum = rows_[static_cast<std::size_t>(row)] = {};
    for (int x = work.x0; x < work.x1; x += step) {
      const double depth = frame.plane(PlaneId::kDepth).at(x, y);
      if (!(depth < 1e30 && heights.at(x, depth) < 0)) continue;
      if (frame.plane(PlaneId::kShadow).at(x, y) < kLit) continue;
      for (int k = 0; k < 3; ++k) {
        const double whole = frame.plane(plane_after(PlaneId::kColorR, k)).at(x, y);
        const double direct = frame.plane(plane_after(PlaneId::kSunColorR, k)).at(x, y);
        sum.sun[static_cast<std::size_t>(k)] += std::clamp(direct, 0.0, std::max(whole, 0.0));
        sum.rest[static_cast<std::size_t>(k)] += std::max(whole - std::max(direct, 0.0), 0.0);
      }
    }
  });
  std::array<double, 3> over_rest{};
  for (std::size_t k = 0; k < 3; ++k) {
    double sun = 0, rest = 0;
    for (const Sums& of_row : rows_) sun += of_row.sun[k], rest += of_row.rest[k];
    over_rest[k] = rest > 0 ? std::min(sun / rest, kMaxSun) : 0;
  }
  return over_rest;
}

}  // namespace limpid

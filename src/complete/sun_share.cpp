#include "complete/sun_share.h"

#include <algorithm>

#include "complete/row_heights.h"
#include "complete/rows.h"

namespace limpid {
namespace {

constexpr int kLooks = 160;      ///< along the longer side of the picture
constexpr double kMaxSun = 100;  ///< over the rest of the light, where that is almost nothing
constexpr float kLit = 0.95f, kShaded = 0.05f;
constexpr float kSameDepth = 0.97f;  ///< quotient of the depths of two places of one surface
constexpr double kMostOfEdges = 20;  ///< a shadow that is almost black tells no more
constexpr double kEnough = 32;       ///< pairs of places

int step_of(const Rect& work) {
  return std::max(4, std::max(work.width(), work.height()) / kLooks);
}

}  // namespace

std::array<double, 3> SunShare::over_shadows(const Frame& frame, const Pass& c,
                                             const std::array<double, 3>& of_sky,
                                             Executor& executor) {
  const Rect work = frame.work();
  const int step = step_of(work), rows = (work.height() + step - 1) / step;
  const std::size_t most = 8 * static_cast<std::size_t>((work.width() + step - 1) / step);
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  const View<const float>& shadow = frame.plane(PlaneId::kShadow);
  edges_.resize(static_cast<std::size_t>(rows));
  quotients_.reserve(most * edges_.size());
  each_row(executor, {0, 0, 1, rows}, [&](int row) {
    const int y = work.y0 + row * step;
    std::vector<std::array<float, 3>>& edges = edges_[static_cast<std::size_t>(row)];
    edges.clear();
    edges.reserve(most);
    const auto is_bottom = [&](int at_x, int at_y) {
      const float far = depth.at(at_x, at_y);
      return far < 1e30f && RowHeights(c, at_y).at(at_x, far) < 0;
    };
    for (int x = work.x0; x < work.x1; x += step) {
      if (!(shadow.at(x, y) > kLit && is_bottom(x, y))) continue;
      for (const auto [to_x, to_y] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        for (const int away : {step, 2 * step}) {
          const int dark_x = x + to_x * away, dark_y = y + to_y * away;
          const Rect dark{dark_x, dark_y, dark_x + 1, dark_y + 1};
          if (!work.contains(dark) || !(shadow.at(dark_x, dark_y) < kShaded)) continue;
          const float here = depth.at(x, y), there = depth.at(dark_x, dark_y);
          const bool same = there > kSameDepth * here && kSameDepth * there < here;
          if (!same || !is_bottom(dark_x, dark_y)) continue;
          std::array<float, 3>& quotient = edges.emplace_back();
          for (int k = 0; k < 3; ++k) {
            const View<const float>& color = frame.plane(plane_after(PlaneId::kColorR, k));
            const float of_dark = std::max(color.at(dark_x, dark_y), 1e-6f);
            quotient[static_cast<std::size_t>(k)] = color.at(x, y) / of_dark;
          }
        }
      }
    }
  });
  std::array<double, 3> over_rest = of_sky;
  for (std::size_t k = 0; k < 3; ++k) {
    quotients_.clear();
    for (const auto& edges : edges_) {
      for (const auto& quotient : edges) quotients_.push_back(quotient[k]);
    }
    const double share = std::clamp(static_cast<double>(quotients_.size()) / kEnough - 1, 0.0, 1.0);
    if (share == 0) return of_sky;
    const auto middle = quotients_.begin() + static_cast<std::ptrdiff_t>(quotients_.size() / 2);
    std::nth_element(quotients_.begin(), middle, quotients_.end());
    const double median = std::clamp(*middle - 1.0, 0.0, kMostOfEdges);
    over_rest[k] += share * (median - over_rest[k]);
  }
  return over_rest;
}

std::array<double, 3> SunShare::over_rest(const Frame& frame, const Pass& c,
                                          const std::array<double, 3>& of_sky, Executor& executor) {
  if (!c.planes.has(PlaneId::kShadow)) return {};
  if (!c.planes.covers(kSunColorPlanes)) return over_shadows(frame, c, of_sky, executor);
  const Rect work = frame.work();
  const int step = step_of(work), rows = (work.height() + step - 1) / step;
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

#include "complete/edge_surfaces.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "complete/row_heights.h"
#include "complete/rows.h"

namespace limpid {
namespace {

/// A side has as many columns as the longer side has texels, but no more than this: Vulkan promises
/// textures of 4096 texels, of which two repeat the outermost.
constexpr int kMostColumns = 1023;
/// Depths are counted up to this, in scene units: beyond, a surface is as good as infinitely far.
constexpr double kFarthest = 1e6;
/// Light is counted up to the largest half: in sums of larger numbers the rest would be lost.
constexpr float kBrightest = 65504;
/// In a room a texel counts as at most so many times as bright as the median of the surfaces: the
/// mean of a ceiling and its lamps would be a haze in the mirror.
constexpr float kLamp = 4;

/// The outermost texels of a window, in the order of op/round_edge.h.
class EdgeTexels {
 public:
  EdgeTexels(const Rect& window, int columns) : w_(window), columns_(columns) {}

  int length(int side) const { return side % 2 == 0 ? w_.width() : w_.height(); }
  double around() const { return 2.0 * (w_.width() + w_.height()); }
  /// Calls see(x, y) for each texel of a column of a side: one or more.
  template <class See>
  void each_of(int side, int column, const See& see) const {
    const auto place = [&](int at) {
      return static_cast<int>(static_cast<std::int64_t>(at) * length(side) / columns_);
    };
    const int begin = place(column), end = std::max(place(column + 1), begin + 1);
    for (int i = begin; i < end; ++i) {
      switch (side) {
        case 0:
          see(w_.x0 + i, w_.y0);
          break;
        case 1:
          see(w_.x1 - 1, w_.y0 + i);
          break;
        case 2:
          see(w_.x1 - 1 - i, w_.y1 - 1);
          break;
        default:
          see(w_.x0, w_.y1 - 1 - i);
      }
    }
  }
  /// Where a column begins, in pixels around the window.
  double begin_of(int column) const {
    const int side = column / columns_;
    double begin = 0;
    for (int i = 0; i < side; ++i) begin += length(i);
    return begin + step_of(column) * (column % columns_);
  }
  /// Pixels of a column.
  double step_of(int column) const { return double(length(column / columns_ % 4)) / columns_; }
  /// The column at a place in pixels, and what is left of it, in columns: 0 to below 4 sides.
  double column_at(double pixels) const {
    for (int side = 0; side < 4; ++side) {
      if (pixels < length(side)) return columns_ * (side + pixels / length(side));
      pixels -= length(side);
    }
    return 4.0 * columns_;
  }

 private:
  Rect w_;
  int columns_;
};

/// The median of the largest channels of the surfaces, 0 without surfaces. Uses the memory of
/// `lights`.
float median_light(const Frame& frame, const Pass& pass, const EdgeTexels& texels, int columns,
                   std::vector<float>& lights) {
  lights.clear();
  glm::ivec2 last(INT_MIN);  // a texel may have several columns
  for (int i = 0; i < 4 * columns; ++i) {
    texels.each_of(i / columns, i % columns, [&](int x, int y) {
      const double z = frame.plane(PlaneId::kDepth).at(x, y);
      const bool stands = z < 1e30 && RowHeights(pass, y).at(x, z) > 0;
      if (!stands || glm::ivec2(x, y) == std::exchange(last, {x, y})) return;
      const auto light = [&](int c) {
        return frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
      };
      const float most = std::max({light(0), light(1), light(2)});
      if (most >= 0) lights.push_back(most);
    });
  }
  if (lights.empty()) return 0;
  const auto middle = lights.begin() + static_cast<std::ptrdiff_t>(lights.size() / 2);
  std::nth_element(lights.begin(), middle, lights.end());
  return *middle;
}

/// A surface that looks down rises less than half as much towards the edge as
/// an upright one does.
double closed_at_top(const View<const float>& depth, const Rect& window, const Pass& pass) {
  constexpr int kRows = 32;  // of so many parts of the picture's height
  const int edge = window.y0, inner = edge + std::max(window.height() / kRows, 1);
  if (inner >= window.y1) return 0;
  const RowHeights at_edge(pass, edge), at_inner(pass, inner);
  int stands = 0, looks_down = 0;
  for (int x = window.x0; x < window.x1; ++x) {
    const double z = depth.at(x, edge), inner_z = depth.at(x, inner);
    if (!(z < 1e30 && at_edge.at(x, z) > 0)) continue;
    ++stands;
    if (!(inner_z < 1e30)) continue;
    const double rise = at_edge.at(x, z) - at_inner.at(x, inner_z);
    const double upright = at_edge.at(x, z) - at_inner.at(x, z);
    looks_down += at_inner.at(x, inner_z) > 0 && std::abs(rise) < 0.5 * upright;
  }
  const auto share = [&](int count) { return double(count) / window.width(); };
  return std::min(4 * share(looks_down), 1.0) * std::clamp(2.5 * share(stands) - 1.25, 0.0, 1.0);
}

}  // namespace

double closed_share(const Frame& frame, const Pass& pass) {
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  return depth ? closed_at_top(depth, depth.window, pass) : 0;
}

const EdgeSurfaces* EdgeSurfacesMaker::make(const Frame& frame, const Pass& pass,
                                            Executor& executor) {
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  Rect window = depth.window;
  for (int c = 0; c < 3; ++c) {
    window = intersection(window, frame.plane(plane_after(PlaneId::kColorR, c)).window);
  }
  const int longer = std::max(window.width(), window.height());
  const int columns = std::min(longer, kMostColumns), around = 4 * columns;
  const EdgeTexels texels(window, columns);
  sums_.assign(static_cast<std::size_t>(around) + 1, {});
  surfaces_.closed = closed_at_top(depth, window, pass);
  const float median =
      surfaces_.closed > 0 ? median_light(frame, pass, texels, columns, lights_) : 0;
  const double brightest = median > 0 ? kLamp * median / surfaces_.closed : kBrightest;
  for (int i = 0; i < around; ++i) {
    Numbers sum{};
    int count = 0;
    texels.each_of(i / columns, i % columns, [&](int x, int y) {
      ++count;
      const double z = depth.at(x, y);
      const RowHeights heights(pass, y);
      if (!(z < 1e30)) {
        sum[kAbove] += heights.under + x * heights.under_step > 0;
        return;
      }
      if (!(heights.at(x, z) > 0)) return;
      std::array<double, 3> light;
      for (std::size_t c = 0; c < 3; ++c) {
        const PlaneId id = plane_after(PlaneId::kColorR, static_cast<int>(c));
        light[c] = std::clamp(frame.plane(id).at(x, y), -kBrightest, kBrightest);
      }
      const double most = std::max({light[0], light[1], light[2]});
      const double kept = most > brightest ? brightest / most : 1;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += kept * light[c];
      sum[kStands] += 1;
      sum[kAbove] += 1;
      sum[kDepth] += std::min(z, kFarthest);
      sum[kSquare] += std::min(z, kFarthest) * std::min(z, kFarthest);
    });
    const auto at = static_cast<std::size_t>(i);
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sums_[at + 1][k] = sums_[at][k] + texels.step_of(i) * sum[k] / count;
    }
  }

  for (Plane& plane : planes_) {
    const Rect whole{0, 0, around, EdgeSurfaces::kRows};
    if (!plane || plane.view().window != whole) plane = Plane(whole);
  }
  surfaces_.reach = 0.5 * longer;
  each_row(executor, {0, 0, around, EdgeSurfaces::kRows}, [&](int row) {
    const double part = row / (EdgeSurfaces::kRows - 1.0);
    for (int i = 0; i < around; ++i) {
      const double own = 0.5 * texels.step_of(i), middle = texels.begin_of(i) + own;
      const double half =
          std::min(std::max(surfaces_.reach * part * part, own), 0.5 * texels.around());
      // The sum up to a place, which may be before the first column or behind the last.
      const auto up_to = [&](double pixels) {
        const double turns = std::floor(pixels / texels.around());
        const double column = texels.column_at(pixels - turns * texels.around());
        const int whole = std::clamp(static_cast<int>(column), 0, around - 1);
        const Numbers &before = sums_[static_cast<std::size_t>(whole)],
                      &after = sums_[static_cast<std::size_t>(whole) + 1];
        Numbers sum;
        for (std::size_t k = 0; k < sum.size(); ++k) {
          sum[k] = turns * sums_.back()[k] + before[k] + (column - whole) * (after[k] - before[k]);
        }
        return sum;
      };
      const Numbers first = up_to(middle - half), last = up_to(middle + half);
      const auto mean = [&](std::size_t k) { return (last[k] - first[k]) / (2 * half); };
      const auto put = [&](std::size_t plane, double value) {
        planes_[plane].view().at(i, row) = static_cast<float>(value);
      };
      for (std::size_t c = 0; c < 3; ++c) put(c, mean(c));
      // Differences of sums are not exact.
      const double share = std::clamp(mean(kStands), 0.0, 1.0), depths = mean(kDepth);
      put(3, share);
      put(4, share > 1e-9 && depths > 0 ? share * std::max(mean(kSquare), 0.0) / depths : 0);
      put(5, std::clamp(mean(kAbove), 0.0, 1.0));
    }
  });
  for (std::size_t k = 0; k < 3; ++k) {
    surfaces_.colors.channels[k] = planes_[k].view();
    surfaces_.shape.channels[k] = planes_[3 + k].view();
  }
  return &surfaces_;
}

}  // namespace limpid

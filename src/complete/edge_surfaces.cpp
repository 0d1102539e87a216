#include "complete/edge_surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "complete/row_heights.h"
#include "complete/rows.h"

namespace limpid {
namespace {

/// A side has as many columns as the longer side has texels, but no more than this.
constexpr int kMostColumns = 2048;
/// Depths are counted up to this, in scene units: beyond, a surface is as good as infinitely far.
constexpr double kFarthest = 1e6;
constexpr double kBrightest = 1e30;  // infinite light would leave no number in differences of sums

/// The outermost texels of a window, in the order of op/round_edge.h.
class EdgeTexels {
 public:
  EdgeTexels(const Rect& window, int columns) : w_(window), columns_(columns) {}

  int length(int side) const { return side % 2 == 0 ? w_.width() : w_.height(); }
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

 private:
  Rect w_;
  int columns_;
};

}  // namespace

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
  for (int i = 0; i < around; ++i) {
    Numbers sum{};
    int count = 0;
    texels.each_of(i / columns, i % columns, [&](int x, int y) {
      ++count;
      const double z = depth.at(x, y);
      const RowHeights heights(pass, y);
      if (!(z < 1e30)) {
        sum[4] += heights.under + x * heights.under_step > 0;
        return;
      }
      if (!(heights.at(x, z) > 0)) return;
      for (int c = 0; c < 3; ++c) {
        const double light = frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
        sum[static_cast<std::size_t>(c)] += std::clamp(light, -kBrightest, kBrightest);
      }
      sum[3] += 1;
      sum[4] += 1;
      sum[5] += std::min(z, kFarthest);
      sum[6] += std::min(z, kFarthest) * std::min(z, kFarthest);
    });
    const auto at = static_cast<std::size_t>(i);
    for (std::size_t k = 0; k < sum.size(); ++k) sums_[at + 1][k] = sums_[at][k] + sum[k] / count;
  }

  for (Plane& plane : planes_) {
    const Rect whole{0, 0, around, EdgeSurfaces::kRows};
    if (!plane || plane.view().window != whole) plane = Plane(whole);
  }
  surfaces_.reach = 0.5 * longer;
  each_row(executor, {0, 0, around, EdgeSurfaces::kRows}, [&](int row) {
    const double part = row / (EdgeSurfaces::kRows - 1.0), pixels = surfaces_.reach * part * part;
    for (int i = 0; i < around; ++i) {
      const double step = double(columns) / texels.length(i / columns);
      const int half = std::min(static_cast<int>(std::lround(pixels * step)), around / 2 - 1);
      // The sum up to a place before the first or behind the last column.
      const auto up_to = [&](int place, std::size_t k) {
        const int turns = place < 0 ? -1 : place > around ? 1 : 0;
        return turns * sums_.back()[k] + sums_[static_cast<std::size_t>(place - turns * around)][k];
      };
      const auto mean = [&](std::size_t k) {
        return (up_to(i + half + 1, k) - up_to(i - half, k)) / (2 * half + 1);
      };
      const auto put = [&](std::size_t plane, double value) {
        planes_[plane].view().at(i, row) = static_cast<float>(value);
      };
      for (std::size_t c = 0; c < 3; ++c) put(c, mean(c));
      const double share = std::max(mean(3), 0.0), depths = mean(5);
      put(3, share);
      put(4, depths > 0 ? share * std::max(mean(6), 0.0) / depths : 0);
      put(5, std::max(mean(4), 0.0));
    }
  });
  for (std::size_t k = 0; k < 3; ++k) {
    surfaces_.colors.channels[k] = planes_[k].view();
    surfaces_.shape.channels[k] = planes_[3 + k].view();
  }
  return &surfaces_;
}

}  // namespace limpid

#include "complete/slope_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "complete/rows.h"
#include "core/box_mean.h"
#include "core/mean_of_four.h"

namespace limpid {
namespace {

constexpr int kMoments = TextureLevels::kMoments;

/// Repeats the first column and the first row.
void close_row(const LevelSizes& sizes, int level, int y, float* plane) {
  plane[sizes.place(level, sizes.width[level], y)] = plane[sizes.place(level, 0, y)];
  if (y > 0) return;
  std::copy_n(plane + sizes.place(level, 0, 0), sizes.width[level] + 1,
              plane + sizes.place(level, 0, sizes.height[level]));
}

}  // namespace

void SlopeMap::make(const TextureLevels& map, const FourShifts& shifts, Executor& executor) {
  const Size base = map.base;
  const LevelSizes sizes = levels_from(base);
  levels_.sizes = sizes;
  levels_.map_texels = std::ldexp(1, map.halvings);
  moments_.resize(static_cast<std::size_t>(sizes.texels) * kMoments);
  std::array<float*, kMoments> planes;
  for (int c = 0; c < kMoments; ++c) {
    levels_.planes[c] = planes[c] = moments_.data() + c * sizes.texels;
  }
  const std::int64_t area = rect_of(base).area();
  const float within = static_cast<float>(map.halvings > 0 ? kept_within(shifts, base) : 0);
  each_row(executor, rect_of(base), [&](int y) {
    std::array<float*, kMoments> row;
    for (int c = 0; c < kMoments; ++c) row[c] = planes[c] + sizes.place(0, 0, y);
    for (int c = 0; c < 2; ++c) mean_of_four(map.moments + c * area, base, shifts, y, row[c]);
    for (int x = 0; x < base.width; ++x) {
      const float h_x = row[0][x], h_y = row[1][x];
      row[2][x] = h_x * h_x, row[3][x] = h_x * h_y, row[4][x] = h_y * h_y;
    }
    if (within > 0) {
      const std::ptrdiff_t at = std::ptrdiff_t{y} * base.width;
      const float *m_x = map.moments + at, *m_y = m_x + area;
      const float* m[] = {m_y + area, m_y + 2 * area, m_y + 3 * area};
      for (int x = 0; x < base.width; ++x) {
        row[2][x] += within * (m[0][x] - m_x[x] * m_x[x]);
        row[3][x] += within * (m[1][x] - m_x[x] * m_y[x]);
        row[4][x] += within * (m[2][x] - m_y[x] * m_y[x]);
      }
    }
    for (float* plane : planes) close_row(sizes, 0, y, plane);
  });
  for (int level = 1; level < sizes.count; ++level) {
    const Size from = sizes.size(level - 1), to = sizes.size(level);
    each_row(executor, rect_of(to), [&](int y) {
      for (int x = 0; x < to.width; ++x) {
        const auto mean = box_mean<kMoments>(from, to, x, y, [&](int i, int j) {
          std::array<float, kMoments> texel;
          for (int c = 0; c < kMoments; ++c) texel[c] = planes[c][sizes.place(level - 1, i, j)];
          return texel;
        });
        for (int c = 0; c < kMoments; ++c) planes[c][sizes.place(level, x, y)] = mean[c];
      }
      for (float* plane : planes) close_row(sizes, level, y, plane);
    });
  }
}

}  // namespace limpid

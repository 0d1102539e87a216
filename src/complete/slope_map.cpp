#include "limpid/complete/slope_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "complete/rows.h"
#include "core/box_mean.h"

namespace limpid {
namespace {

constexpr int kMoments = TextureLevels::kMoments;
constexpr double kDirections[][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

/// to[x] += weight * from[(x + shift) % width], 0 <= shift < width.
void add_turned(const float* from, int width, int shift, float weight, float* to) {
  const int until = width - shift;
  for (int x = 0; x < until; ++x) to[x] += weight * from[x + shift];
  for (int x = until; x < width; ++x) to[x] += weight * from[x - until];
}

/// A move along an axis as texels and the share of the next one.
struct Moved {
  int texels;
  float rest;
  Moved(double periods, int size) {
    const double at = (periods - std::floor(periods)) * size, whole = std::floor(at);
    texels = static_cast<int>(whole) % size;
    rest = static_cast<float>(at - whole);
  }
};

/// The share of what varies within texels that the mean of the four keeps.
double kept_within(double drift, Size size) {
  double sum = 0;
  for (const auto& a : kDirections) {
    for (const auto& b : kDirections) {
      const double x = std::remainder(drift * (a[0] - b[0]), 1.0) * size.width;
      const double y = std::remainder(drift * (a[1] - b[1]), 1.0) * size.height;
      sum += std::max(1 - std::hypot(x, y), 0.0) / 16;
    }
  }
  return sum;
}

/// Means of one plane, over the four lookups, for a row of the map.
void mean_of_four(const float* plane, Size size, double drift, int y, float* to) {
  std::fill_n(to, size.width, 0.0f);
  for (const auto& along : kDirections) {
    const Moved x(along[0] * drift, size.width), down(along[1] * drift, size.height);
    for (int j = 0; j < 2; ++j) {
      const float of_row = j == 0 ? 1 - down.rest : down.rest;
      const float* row = plane + std::ptrdiff_t{(y + down.texels + j) % size.height} * size.width;
      for (int i = 0; i < 2; ++i) {
        const float weight = 0.25f * of_row * (i == 0 ? 1 - x.rest : x.rest);
        if (weight != 0) add_turned(row, size.width, (x.texels + i) % size.width, weight, to);
      }
    }
  }
}

/// The first column once more, and so the first row.
void close_row(const LevelSizes& sizes, int level, int y, float* plane) {
  plane[sizes.place(level, sizes.width[level], y)] = plane[sizes.place(level, 0, y)];
  if (y > 0) return;
  std::copy_n(plane + sizes.place(level, 0, 0), sizes.width[level] + 1,
              plane + sizes.place(level, 0, sizes.height[level]));
}

}  // namespace

void SlopeMap::make(const TextureLevels& map, double drift, Executor& executor) {
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
  const float within = static_cast<float>(map.halvings > 0 ? kept_within(drift, base) : 0);
  each_row(executor, rect_of(base), [&](int y) {
    std::array<float*, kMoments> row;
    for (int c = 0; c < kMoments; ++c) row[c] = planes[c] + sizes.place(0, 0, y);
    for (int c = 0; c < 2; ++c) mean_of_four(map.moments + c * area, base, drift, y, row[c]);
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

#include "complete/bottom_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "complete/basin.h"
#include "complete/row_heights.h"
#include "complete/rows.h"
#include "complete/sun_sight.h"

namespace limpid {
namespace {

/// Pixels along a cell of a picture up to 1.5 times as wide as kWide: twice as many of one up
/// to 2.5 times as wide, and so on.
constexpr int kCell = 8;
constexpr double kWide = 1920;
constexpr int kSamples = 4;    ///< along a cell: enough for sums
constexpr float kDepths = 1;   ///< distance to which sums reach on each side, in depths of water
constexpr int kMaxReach = 24;  ///< cells

Rect window_of(const Frame& frame) {
  Rect window = frame.work();
  for (int i = 0; i < 3; ++i) {
    window = intersection(window, frame.plane(plane_after(PlaneId::kColorR, i)).window);
  }
  return intersection(window, frame.plane(PlaneId::kDepth).window);
}

/// How much of the window through which the views of a picture begin lies over the calm water.
double share_in_air(const Pass& c) {
  if (!c.submersible) return 1;
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (const double x : {0, c.size.x}) {
    for (const double y : {0, c.size.y}) {
      const glm::dvec3 corner = c.rays.origin_at(x, y) + c.near * c.rays.ray_at(x, y);
      const double height = c.eye_above + glm::dot(c.up, corner);
      lowest = std::min(lowest, height), highest = std::max(highest, height);
    }
  }
  if (!(lowest < 0)) return 1;
  return highest > 0 ? highest / (highest - lowest) : 0;
}

int cell_of(const Pass& c) {
  return kCell * std::max(1, static_cast<int>(std::lround(std::max(c.size.x, c.size.y) / kWide)));
}

}  // namespace

/// Sums the cells of one row.
void BottomAlbedo::gather(const Frame& frame, const Pass& c, const Rgb<double>& sky, int row) {
  const Rect window = window_of(frame);
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  const View<const float>& shadow = frame.plane(PlaneId::kShadow);
  const double rise = c.has_sun ? std::max(glm::dot(c.sun.direction, c.up), 0.0) : 0;
  const std::array<float, 3> sun{static_cast<float>(rise * c.sun.color.r),
                                 static_cast<float>(rise * c.sun.color.g),
                                 static_cast<float>(rise * c.sun.color.b)};
  const std::array<float, 3> even{static_cast<float>(sky.r), static_cast<float>(sky.g),
                                  static_cast<float>(sky.b)};
  const double pixels = glm::length(c.to_u) * c.size.x;  // pixels per unit of length at w = 1
  Cell* cells = cells_.data() + static_cast<std::size_t>(row) * columns_;
  std::fill_n(cells, columns_, Cell{});
  for (int column = 0; column < columns_; ++column) cells[column][kLit] = 1;
  const int begin = window.y0 + row * cell_;
  const int step = cell_ / kSamples;
  if (!shadow && rise > 0) look_for_shade(depth, c, window, row);
  for (int y = begin; y < std::min(begin + cell_, window.y1); y += step) {
    const RowHeights heights(c, y);
    for (int x = window.x0; x < window.x1; x += step) {
      const double far = depth.at(x, y);
      const double under = -heights.at(x, far);
      if (!(far > 0 && far < 1e30 && under > 0)) continue;
      Cell& cell = cells[(x - window.x0) / cell_];
      const float lit = shadow ? shadow.at(x, y) : cell[kLit];
      for (int i = 0; i < 3; ++i) {
        const std::size_t k = static_cast<std::size_t>(i);
        cell[kColor + k] += frame.plane(plane_after(PlaneId::kColorR, i)).at(x, y);
        cell[kLight + k] += lit * sun[k] + even[k];
      }
      const double w = std::max(c.w_origin + c.w_depth * far, 1e-30);
      cell[kDrop] += static_cast<float>(under);
      cell[kReach] += static_cast<float>(std::min(under * pixels / w, 1e4));
      cell[kCount] += 1;
    }
  }
}

/// Without a shadow plane: whether the picture shows what shades the texel in the middle of each
/// cell of a row.
void BottomAlbedo::look_for_shade(const View<const float>& depth, const Pass& c, const Rect& window,
                                  int row) {
  const SunSight sight(depth, c);
  const int y = std::min(window.y0 + row * cell_ + cell_ / 2, window.y1 - 1);
  const RowHeights heights(c, y);
  for (int column = 0; column < columns_; ++column) {
    const int x = std::min(window.x0 + column * cell_ + cell_ / 2, window.x1 - 1);
    const double far = depth.at(x, y);
    if (!(far > 0 && far < 1e30 && heights.at(x, far) < 0)) continue;
    const double hidden = sight.hidden_from_surface(x, y);
    cells_[static_cast<std::size_t>(row) * columns_ + column][kLit] =
        static_cast<float>(1 - hidden);
  }
}

/// Searches walls for a row of blocks, each by the texel in its middle.
void BottomAlbedo::look_for_walls(const Frame& frame, const Pass& c, const WaterOver& water,
                                  int row) {
  const Rect window = window_of(frame);
  const Basin basin(frame, c);
  const double share = share_in_air(c);
  const View<const float>& shadow = frame.plane(PlaneId::kShadow);
  const Basin::Lit lit = [&](int at_x, int at_y) -> std::optional<float> {
    if (!(shadow ? shadow.window : window).contains(Rect{at_x, at_y, at_x + 1, at_y + 1}))
      return {};
    if (shadow) return shadow.at(at_x, at_y);
    const int cell = (at_y - window.y0) / cell_ * columns_ + (at_x - window.x0) / cell_;
    return cells_[static_cast<std::size_t>(cell)][kLit];
  };
  const int pixels = kBlock * cell_;
  const int y = std::min(window.y0 + row * pixels + pixels / 2, window.y1 - 1);
  const RowHeights heights(c, y);
  for (int column = 0; column < columns_; column += kBlock) {
    const int x = std::min(window.x0 + column * cell_ + pixels / 2, window.x1 - 1);
    const double far = frame.plane(PlaneId::kDepth).at(x, y), drop = -heights.at(x, far);
    if (!(far > 0 && far < 1e30 && drop > 0)) continue;
    const Basin::Walls walls = basin.walls_around(x, y);
    const Basin::Floor floor = basin.floor_around(x, y, lit);
    const std::array<double, 3> rates{water.rate.r, water.rate.g, water.rate.b};
    for (std::size_t i = 0; i < 3; ++i) {
      const Basin::Reflected light = Basin::reflected(rates[i] * drop, c.ior);
      const auto thrown = static_cast<float>(share * Basin::share_on(walls, light));
      const auto shade = static_cast<float>(share * (1 - Basin::share_sunlit(floor, light)));
      for (int r = row * kBlock; r < std::min((row + 1) * kBlock, rows_); ++r) {
        for (int k = column; k < std::min(column + kBlock, columns_); ++k) {
          Cell& cell = cells_[static_cast<std::size_t>(r) * columns_ + k];
          cell[kWalls + i] = thrown * cell[kCount];
          cell[kShade + i] = shade * cell[kCount];
        }
      }
    }
  }
}

/// The albedo of an endless floor in the sun that is as bright in this water as this floor, which
/// has walls and shade around. `sun`, `even`: light of the sun and of the sky on a level floor.
float BottomAlbedo::as_of_level(float albedo, const Cell& sums, std::size_t channel, double sun,
                                double even, const WaterOver& water) {
  const ScatteredLight& light = water.light[channel];
  const double rate = std::array{water.rate.r, water.rate.g, water.rate.b}[channel];
  const double depth = std::min(rate * sums[kDrop] / sums[kCount], 1e6), x = layer_variable(depth);
  const double back = light.back_at_once + layer_power(light.back, x);
  // Walls all around: the sun lights half of them, by the cosine with each.
  const double cosine = std::clamp(water.beam, 0.02, 1.0);
  const double level = std::sqrt(1 - cosine * cosine) / cosine;
  const double sunlit = sums[kLight + channel] - even * sums[kCount];
  const double of_floor = std::clamp(
      (even * sums[kCount] + sunlit * level / std::numbers::pi) / sums[kLight + channel], 0.0, 1.0);
  const double lost = (1 - of_floor) * sums[kWalls + channel] / sums[kCount];
  const double most = std::min<double>(albedo, ScatteredLight::kMaxAlbedo);
  const double lit = std::clamp(
      1 - sun * sums[kShade + channel] / (sums[kCount] * std::max(sun + even, 1e-30)), 0.0, 1.0);
  if (!(light.back_at_once > 0 && (lost > 0 || lit < 1) && most > 0)) return albedo;
  // The dry picture already has the light that reached the bottom and rose without scattering.
  const double beam = cosine * std::exp(-depth / cosine), left = std::exp(-depth);
  const double passing = left + layer_power(light.passing, std::array{1.0, 1.0}, x);
  const double below = beam + layer_power(light.sun_below, x);
  const double had = std::clamp(beam * left / std::max(passing * below, 1e-30), 0.0, 1.0);
  const double again = most * std::max(back - lost, 0.0);
  const double more = most * (1 - had + lit * again / (1 - again));
  // a (1 / (1 - a back) - had) = more
  const double linear = 1 - had + more * back, square = had * back;
  const double root = std::sqrt(linear * linear + 4 * square * more);
  return static_cast<float>(std::min(2 * more / std::max(linear + root, 1e-30), most));
}

/// In cells, equal for the whole picture: the mean over its pixels.
int BottomAlbedo::reach() const {
  double sum = 0, count = 0;
  for (const Cell& cell : cells_) sum += cell[kReach], count += cell[kCount];
  if (!(count > 0)) return 0;
  return std::clamp(static_cast<int>(kDepths * sum / count / cell_), 1, kMaxReach);
}

/// Sums all cells within `reach`, across and down, twice.
void BottomAlbedo::spread(int reach, Executor& executor) {
  const int wide = 2 * reach + 1;
  // The cells around one are the end of a block of as many cells and the beginning of the next
  // block. Sums of ends and beginnings cost the same for any reach, and unlike differences of sums
  // they keep infinity where it is.
  const auto line = [&](const Cell* from, Cell* to, int count, int step) {
    const auto add = [&](Cell& sum, int i) {
      if (i < 0 || i >= count) return;
      const Cell& cell = from[static_cast<std::ptrdiff_t>(i) * step];
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += cell[k];
    };
    std::array<Cell, 2 * kMaxReach + 1> ends;
    for (int block = 0; block < count; block += wide) {
      Cell sum{};
      for (int k = wide - 1; k >= 0; --k) {
        add(sum, block - reach + k);
        ends[static_cast<std::size_t>(k)] = sum;
      }
      sum = {};
      for (int k = 0; k < std::min(wide, count - block); ++k) {
        if (k > 0) add(sum, block + reach + k);
        Cell& around = to[static_cast<std::ptrdiff_t>(block + k) * step];
        for (std::size_t n = 0; n < sum.size(); ++n)
          around[n] = ends[static_cast<std::size_t>(k)][n] + sum[n];
      }
    }
  };
  sums_.resize(cells_.size());
  for (int round = 0; round < 2; ++round) {
    each_row(executor, {0, 0, 1, rows_}, [&](int y) {
      const std::ptrdiff_t at = std::ptrdiff_t{y} * columns_;
      line(cells_.data() + at, sums_.data() + at, columns_, 1);
    });
    each_row(executor, {0, 0, 1, columns_},
             [&](int x) { line(sums_.data() + x, cells_.data() + x, rows_, columns_); });
  }
}

/// Linear between the centres of the cells.
void BottomAlbedo::draw_row(const Rect& window, int y) {
  const float size = static_cast<float>(cell_);
  const float at_y = (static_cast<float>(y - window.y0) + 0.5f) / size - 0.5f;
  const int low = static_cast<int>(std::floor(at_y));
  const float part_y = at_y - static_cast<float>(low);
  const auto row = [&](int r) {
    return drawn_.data() + static_cast<std::size_t>(std::clamp(r, 0, rows_ - 1)) * columns_;
  };
  const std::array<float, 4>*above = row(low), *below = row(low + 1);
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    float* out = planes_[i].view().row(y);
    const auto middle = [&](int column) {
      const int k = std::clamp(column, 0, columns_ - 1);
      return above[k][i] + part_y * (below[k][i] - above[k][i]);
    };
    float left = middle(-1), right = middle(0);
    for (int column = 0; column <= columns_; ++column) {
      // From the centre of the last cell to the centre of this cell.
      const int first = column * cell_ - cell_ / 2;
      const int begin = std::max(first, 0), end = std::min(first + cell_, window.width());
      const float per_pixel = (right - left) / size;
      for (int x = begin; x < end; ++x) {
        out[x] = left + per_pixel * (static_cast<float>(x - first) + 0.5f);
      }
      left = right, right = middle(column + 1);
    }
  }
}

void BottomAlbedo::make(const Frame& frame, const Pass& pass, const Rgb<double>& sky,
                        const WaterOver& water, Executor& executor) {
  const Rect window = window_of(frame);
  cell_ = cell_of(pass);
  columns_ = (window.width() + cell_ - 1) / cell_;
  rows_ = (window.height() + cell_ - 1) / cell_;
  cells_.resize(static_cast<std::size_t>(columns_) * rows_);
  each_row(executor, {0, 0, 1, rows_}, [&](int row) { gather(frame, pass, sky, row); });
  if (share_in_air(pass) > 0 && (frame.plane(PlaneId::kShadow) || pass.has_sun)) {
    run_each(executor, (rows_ + kBlock - 1) / kBlock,
             [&](int row) { look_for_walls(frame, pass, water, row); });
  }
  spread(reach(), executor);
  const double rise = pass.has_sun ? std::max(glm::dot(pass.sun.direction, pass.up), 0.0) : 0;
  const std::array<double, 3> even{sky.r, sky.g, sky.b};
  const std::array<double, 3> sun{rise * pass.sun.color.r, rise * pass.sun.color.g,
                                  rise * pass.sun.color.b};
  drawn_.resize(cells_.size());
  each_row(executor, {0, 0, columns_, rows_}, [&](int row) {
    const std::size_t first = static_cast<std::size_t>(row) * columns_;
    for (std::size_t n = first; n < first + columns_; ++n) {
      const Cell& cell = cells_[n];
      std::array<float, 4>& drawn = drawn_[n];
      float of_level = 0, channels = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const float albedo = cell[kLight + i] > 0 ? cell[kColor + i] / cell[kLight + i] : 0;
        drawn[i] = std::clamp(albedo, 0.0f, 1.0f);
        if (!(drawn[i] > 0)) continue;
        const bool shaded = cell[kWalls + i] > 0 || cell[kShade + i] > 0;
        of_level +=
            shaded ? as_of_level(drawn[i], cell, i, sun[i], even[i], water) / drawn[i] : 1.0f;
        channels += 1;
      }
      drawn[kBasin] = channels > 0 ? std::clamp(of_level / channels, 0.0f, 1.0f) : 1.0f;
    }
  });
  for (Plane& plane : planes_) {
    if (!plane || plane.view().window != window) plane = Plane(window);
  }
  each_row(executor, window, [&](int y) { draw_row(window, y); });
}

}  // namespace limpid

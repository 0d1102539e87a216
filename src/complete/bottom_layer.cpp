#include "complete/bottom_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "limpid/ops/look.h"

#include "complete/row_heights.h"

namespace limpid {
namespace {

constexpr int kCellsAcross = 240;  ///< of the longer side of a picture, but at least kLeastCell
constexpr int kLeastCell = 4;      ///< pixels
constexpr int kLooks = 2;          ///< lookups across a cell, and down
/// The widest window of the closing reaches this share of the cells to each side.
constexpr int kReachShare = 8;
constexpr float kOfBottom = BottomLayer::kOfBottom;
/// Weight of a cell that is not all bottom: its edges have mixed colors. Also of the feet of
/// objects, and of walls in a layer that is relit: they do not go on behind what stands before
/// them, as a bottom does. Else the dim light on walls stands for the shade on hidden bottom.
constexpr float kMixed = 1e-3f;
constexpr double kLevel = 0.7;  ///< cosine of the steepest bottom
/// Bound on the sun's light over the rest: shade that is almost black has no known color.
constexpr double kMostSun = 20;

/// From cell to cell, a smooth bottom changes 1 / depth by at most this factor times the change
/// before, and by this share.
constexpr float kStep = 3, kSmooth = 0.002f;

/// The least share of a window that an object is assumed to cover.
constexpr float kThinnest = 0.05f;

constexpr float kNone = std::numeric_limits<float>::infinity();

/// In the place of a depth below the calm surface, where nothing is: in the water, or above it.
constexpr float kBottomless = -1, kSky = -2;

/// The best of three numbers `step` apart in a line of `count`, which goes on as it ends.
template <class Better>
void best_of_three(const float* in, float* out, int count, int step, Better better) {
  const auto ended = [&](int x) { return in[std::clamp(x, 0, count - 1)]; };
  const int begin = std::min(step, count), end = std::max(count - step, begin);
  for (int x = 0; x < begin; ++x) out[x] = better(in[x], better(in[0], ended(x + step)));
  for (int x = begin; x < end; ++x) out[x] = better(in[x], better(in[x - step], in[x + step]));
  for (int x = end; x < count; ++x) out[x] = better(in[x], better(ended(x - step), in[count - 1]));
}

/// Widens windows from `reach` to each side by `step`: at most 2 reach + 1.
template <class Better>
void widen(std::vector<float>& field, std::vector<float>& room, Size size, int step,
           Better better) {
  const auto row = [&](std::vector<float>& of, int y) {
    return of.data() + std::ptrdiff_t{std::clamp(y, 0, size.height - 1)} * size.width;
  };
  for (int y = 0; y < size.height; ++y) {
    best_of_three(row(field, y), row(room, y), size.width, step, better);
  }
  for (int y = 0; y < size.height; ++y) {
    const float *above = row(room, y - step), *own = row(room, y), *below = row(room, y + step);
    float* out = row(field, y);
    for (int x = 0; x < size.width; ++x) out[x] = better(own[x], better(above[x], below[x]));
  }
}

constexpr auto kGreater = [](float a, float b) { return a > b ? a : b; };
constexpr auto kLess = [](float a, float b) { return a < b ? a : b; };

}  // namespace

/// A frame as cells.
struct BottomLayerMaker::Scan {
  const Pass& c;
  std::array<View<const float>, 3> color, sun;
  const View<const float>&depth, &shadow;
  Rect window;
  int cell, step;
  Size cells;

  std::array<float, 3> sun_over_rest;
  bool relights = false;

  Scan(const Frame& frame, const Pass& pass, const std::array<double, 3>& over_rest)
      : c(pass), depth(frame.plane(PlaneId::kDepth)), shadow(frame.plane(PlaneId::kShadow)) {
    window = depth.window;
    for (int i = 0; i < 3; ++i) {
      const PlaneId plane = plane_after(PlaneId::kColorR, i);
      color[static_cast<std::size_t>(i)] = frame.plane(plane);
      window = intersection(window, frame.plane(plane).window);
    }
    relights = shadow && shadow.window.contains(window);
    double most = 0;
    const bool known = frame.present().covers(kSunColorPlanes);
    for (std::size_t i = 0; i < 3; ++i) {
      if (known) sun[i] = frame.plane(plane_after(PlaneId::kSunColorR, static_cast<int>(i)));
      relights = relights && (!sun[i] || sun[i].window.contains(window));
      sun_over_rest[i] = static_cast<float>(std::min(over_rest[i], kMostSun));
      most = std::max(most, over_rest[i]);
    }
    relights = relights && most > 0;
    const int longer = std::max(window.width(), window.height());
    cell = std::max(kLeastCell, (longer + kCellsAcross - 1) / kCellsAcross);
    step = cell / kLooks;
    cells = {(window.width() + cell - 1) / cell, (window.height() + cell - 1) / cell};
  }

  /// Color of a texel, as lit by the sun where `relights`.
  std::array<float, 3> color_at(int x, int y) const {
    std::array<float, 3> seen{color[0].at(x, y), color[1].at(x, y), color[2].at(x, y)};
    if (!relights) return seen;
    const float lit = std::clamp(shadow.at(x, y), 0.0f, 1.0f);
    for (std::size_t i = 0; i < 3; ++i) {
      const float rest = sun[i] ? std::max(seen[i] - std::max(sun[i].at(x, y), 0.0f), 0.0f)
                                : seen[i] / (1 + lit * sun_over_rest[i]);
      seen[i] += (1 - lit) * sun_over_rest[i] * rest;
    }
    return seen;
  }

  /// Whether the surface in a cell is no wall, from depths a cell apart.
  bool is_level(int column, int row) const {
    const auto point = [&](int x, int y) {
      return c.rays.origin_at(x - c.corner.x + 0.5, y - c.corner.y + 0.5) +
             double{depth.at(x, y)} * c.rays.ray_at(x - c.corner.x + 0.5, y - c.corner.y + 0.5);
    };
    const int x = std::min(window.x0 + column * cell + cell / 2, window.x1 - 1);
    const int y = std::min(window.y0 + row * cell + cell / 2, window.y1 - 1);
    // Towards the neighbour that is less of another surface.
    const auto step_of = [&](int at, int low, int high, const auto& depth_at) {
      const int back = std::max(at - cell, low), on = std::min(at + cell, high - 1);
      const float here = depth_at(at);
      if (back == at || on == at) return back == at ? on : back;
      return std::abs(depth_at(on) - here) <= std::abs(depth_at(back) - here) ? on : back;
    };
    const int across = step_of(x, window.x0, window.x1, [&](int at) { return depth.at(at, y); });
    const int down = step_of(y, window.y0, window.y1, [&](int at) { return depth.at(x, at); });
    const glm::dvec3 here = point(x, y);
    const glm::dvec3 normal = glm::cross(point(across, y) - here, point(x, down) - here);
    return std::abs(glm::dot(c.up, normal)) > kLevel * glm::length(normal);
  }

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * cells.width + column;
  }

  /// look(column, x, y, z, drop) of every texel that is looked at in a row of cells: how deep it
  /// lies below the calm surface, 0 above it, kBottomless or kSky where nothing is.
  template <class Look>
  void each(int row, Look&& look) const {
    const int begin = window.y0 + row * cell;
    for (int y = begin + step / 2; y < std::min(begin + cell, window.y1); y += step) {
      const RowHeights heights(c, y);
      for (int x = window.x0 + step / 2; x < window.x1; x += step) {
        const float z = depth.at(x, y);
        const auto drop = static_cast<float>(-heights.at(x, z));
        const float none = drop > 0 ? kBottomless : kSky;
        look((x - window.x0) / cell, x, y, z, z < 1e30f ? std::max(drop, 0.0f) : none);
      }
    }
  }
};

/// Calls fn for a cell and its neighbours.
template <class Fn>
void BottomLayerMaker::each_near(Size size, int column, int row, Fn&& fn) const {
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, size.height - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, size.width - 1); ++x) {
      fn(cells_[static_cast<std::size_t>(y) * size.width + x]);
    }
  }
}

/// Finds the highest texel of each cell.
void BottomLayerMaker::survey(const Scan& scan, Executor& executor) {
  const Pass& c = scan.c;
  const double pixels = glm::length(c.to_u) * c.size.x;  // pixels per unit of length at w = 1
  cells_.resize(scan.index(0, scan.cells.height));
  each_row(executor, {0, 0, scan.cells.width, scan.cells.height}, [&](int row) {
    Cell* cells = cells_.data() + scan.index(0, row);
    std::fill_n(cells, scan.cells.width, Cell{kNone, 0, 0, 0, 0, 0, 0, 0, 0});
    scan.each(row, [&](int column, int, int, float z, float drop) {
      Cell& cell = cells[column];
      if (!(drop < cell.highest)) return;
      cell.highest = std::max(drop, 0.0f);
      cell.nearness = 1 / z;
      cell.width = static_cast<float>(scan.cell * (c.w_origin + c.w_depth * z) / pixels);
    });
  });
}

/// Whether any object stands in front of the bottom. Sets for each cell the window that fills the
/// object there, and the depth down to which surfaces belong to the bottom.
bool BottomLayerMaker::find_standing(Size cells) {
  const int most = std::max(1, std::max(cells.width, cells.height) / kReachShare);
  // Padded by the width of the windows, so that a bottom that rises at the edge stays unchanged.
  const Size wide{cells.width + 2 * most, cells.height + 2 * most};
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y + most) * wide.width + (x + most);
  };
  const std::size_t area = static_cast<std::size_t>(wide.width) * wide.height;
  for (std::vector<float>* field : {&dilated_, &closed_, &room_}) field->resize(area);
  for (int y = -most; y < cells.height + most; ++y) {
    for (int x = -most; x < cells.width + most; ++x) {
      const int column = std::clamp(x, 0, cells.width - 1),
                row = std::clamp(y, 0, cells.height - 1);
      dilated_[at(x, y)] = cells_[static_cast<std::size_t>(row) * cells.width + column].highest;
    }
  }
  bool stands = false;
  const auto compare = [&](const std::vector<float>& closed, int window) {
    for (int y = 0; y < cells.height; ++y) {
      for (int x = 0; x < cells.width; ++x) {
        Cell& cell = cells_[static_cast<std::size_t>(y) * cells.width + x];
        const bool higher = cell.highest < kOfBottom * closed[at(x, y)];
        stands = stands || higher;
        if (higher && cell.window == 0) cell.window = window;
      }
    }
  };
  for (int last = 0, reach = 1; last < most; last = reach, reach = std::min(2 * reach, most)) {
    widen(dilated_, room_, wide, reach - last, kGreater);
    closed_ = dilated_;
    for (int closed = 0, step = 0; closed < reach; closed += step) {
      step = std::min(2 * closed + 1, reach - closed);
      widen(closed_, room_, wide, step, kLess);
    }
    compare(closed_, 2 * reach + 1);
  }
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      cells_[static_cast<std::size_t>(y) * cells.width + x].bottom = kOfBottom * closed_[at(x, y)];
    }
  }
  return stands;
}

/// Tells walls, surfaces steeper than 45 degrees, and the feet of objects: the walls that lead from
/// an object down to the bottom.
void BottomLayerMaker::find_walls(const Scan& scan, Executor& executor) {
  const Size size = scan.cells;
  walls_.assign(cells_.size(), Wall::kNone);
  each_row(executor, {0, 0, size.width, size.height}, [&](int row) {
    for (int column = 0; column < size.width; ++column) {
      const Cell& cell = cells_[scan.index(column, row)];
      const bool whole = cell.highest >= cell.bottom && cell.highest < kNone;
      if (whole && !scan.is_level(column, row)) walls_[scan.index(column, row)] = Wall::kWall;
    }
  });
  open_.clear();
  open_.reserve(cells_.size());
  // Down the same surface: depth changes little along a wall.
  constexpr float kWidths = 3;
  const auto leads_to = [&](const Cell& from, const Cell& to) {
    const float apart = std::abs(1 / from.nearness - 1 / to.nearness);
    return to.highest >= from.highest && apart <= kWidths * to.width;
  };
  const auto spread_from = [&](std::size_t from) {
    const int column = static_cast<int>(from % size.width),
              row = static_cast<int>(from / size.width);
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, size.height - 1); ++y) {
      for (int x = std::max(column - 1, 0); x <= std::min(column + 1, size.width - 1); ++x) {
        const std::size_t to = scan.index(x, y);
        if (walls_[to] != Wall::kWall || !leads_to(cells_[from], cells_[to])) continue;
        walls_[to] = Wall::kFoot;
        open_.push_back(to);
      }
    }
  };
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].window > 0) spread_from(i);
  }
  while (!open_.empty()) {
    const std::size_t next = open_.back();
    open_.pop_back();
    spread_from(next);
  }
}

/// Whether the bottom beside a cell of land continues into that cell: then the bottom ends there,
/// and does not continue behind it.
bool BottomLayerMaker::is_shore(Size cells, int column, int row) const {
  const auto at = [&](int x, int y) -> const Cell* {
    const bool inside = x >= 0 && x < cells.width && y >= 0 && y < cells.height;
    return inside ? &cells_[static_cast<std::size_t>(y) * cells.width + x] : nullptr;
  };
  const float own = at(column, row)->nearness;
  for (const auto [x, y] :
       {std::array{1, 0}, std::array{-1, 0}, std::array{0, 1}, std::array{0, -1}}) {
    const Cell *next = at(column + x, row + y), *beyond = at(column + 2 * x, row + 2 * y);
    if (!next || !beyond || !(next->highest > 0) || !(beyond->highest > 0)) continue;
    const float step = std::abs(beyond->nearness - next->nearness);
    if (std::abs(next->nearness - own) < kStep * step + kSmooth * own) return true;
  }
  return false;
}

/// Means of the texels of the bottom, extended over the rest. False if there are none.
bool BottomLayerMaker::fill(const Scan& scan, Executor& executor) {
  const Size size = scan.cells;
  auto& level = bottom_.finest(size);
  each_row(executor, {0, 0, size.width, size.height}, [&](int row) {
    auto* texels = &level.at(0, row);
    std::fill_n(texels, size.width, PullPush<4>::Texel{});
    Cell* cells = cells_.data() + scan.index(0, row);
    scan.each(row, [&](int column, int x, int y, float, float drop) {
      const bool land = drop <= 0;
      cells[column].looks += 1;
      if (drop == kBottomless) cells[column].bottomless += 1;
      if (!(drop >= cells[column].bottom) || (land && !is_shore(size, column, row))) return;
      PullPush<4>::Texel& texel = texels[column];
      const std::array<float, 3> color = scan.color_at(x, y);
      for (std::size_t i = 0; i < 3; ++i) texel[i] += color[i];
      texel[3] += drop;
      texel[4] += 1;
    });
    for (int column = 0; column < size.width; ++column) {
      PullPush<4>::Texel& texel = texels[column];
      cells[column].standing = 1 - texel[4] / std::max(cells[column].looks, 1.0f);
      if (!(texel[4] > 0)) continue;
      for (std::size_t i = 0; i < 4; ++i) texel[i] /= texel[4];
      const bool whole = cells[column].highest >= cells[column].bottom;
      const Wall wall = walls_[scan.index(column, row)];
      const bool bottom = whole && (scan.relights ? wall == Wall::kNone : wall != Wall::kFoot);
      texel[4] = bottom ? 1 : kMixed;
    }
  });
  return bottom_.draw_on(executor);
}

/// Where the bottom ends. False where it does not.
bool BottomLayerMaker::find_end(Size size, Executor& executor) {
  auto& level = end_.finest(size);
  bool ends = false;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    const float known = cell.bottomless + (1 - cell.standing) * cell.looks;
    level.texels[i] = {known > 0 ? cell.bottomless / known : 0, known > 0 ? 1.0f : 0.0f};
    ends = ends || cell.bottomless > 0;
  }
  return ends && end_.draw_on(executor);
}

/// What stands in a cell is as wide as the window that fills it, in which a thing that is narrower
/// covers a share.
float BottomLayerMaker::thinness_at(Size size, int column, int row) const {
  const Cell& own = cells_[static_cast<std::size_t>(row) * size.width + column];
  if (own.window == 0) return 0;
  float standing = 1;
  if (own.window == 3) {
    float sum = 0, count = 0;
    each_near(size, column, row, [&](const Cell& cell) { sum += cell.standing, count += 1; });
    standing = std::max(sum / count, kThinnest);
  }
  return 1 / (static_cast<float>(BottomLayer::kThickness) * standing *
              static_cast<float>(own.window) * own.width);
}

const BottomLayer* BottomLayerMaker::make(const Frame& frame, const Pass& pass,
                                          const std::array<double, 3>& sun_over_rest,
                                          Executor& executor) {
  if (!(pass.eye_above > 0) || pass.submersible) return nullptr;
  const Scan scan(frame, pass, sun_over_rest);
  survey(scan, executor);
  if (!find_standing(scan.cells)) return nullptr;
  find_walls(scan, executor);
  if (!fill(scan, executor)) return nullptr;
  layer_.lit = scan.relights;
  const Rect window{0, 0, scan.cells.width, scan.cells.height};
  const bool ends = find_end(scan.cells, executor);
  for (Plane& plane : planes_) {
    if (!plane || plane.view().window != window) plane = Plane(window);
  }
  layer_.most_drop = 0;
  for (int y = 0; y < window.y1; ++y) {
    for (int x = 0; x < window.x1; ++x) {
      cells_[scan.index(x, y)].thinness = thinness_at(window.size(), x, y);
    }
  }
  for (int y = 0; y < window.y1; ++y) {
    for (int x = 0; x < window.x1; ++x) {
      const PullPush<4>::Texel& texel = bottom_.finest().at(x, y);
      for (std::size_t i = 0; i < 4; ++i) planes_[i].view().at(x, y) = texel[i];
      // Lookups interpolate between cells: the neighbours of an object get its thinness.
      float& thinness = planes_[4].view().at(x, y);
      thinness = 0;
      each_near(window.size(), x, y,
                [&](const Cell& cell) { thinness = std::max(thinness, cell.thinness); });
      planes_[5].view().at(x, y) = ends ? end_.finest().at(x, y)[0] : 0;
      layer_.most_drop = std::max(layer_.most_drop, static_cast<double>(texel[3]));
    }
  }
  layer_.colors.channels = {planes_[0].view(), planes_[1].view(), planes_[2].view()};
  layer_.shape.channels = {planes_[3].view(), planes_[5].view(), planes_[4].view()};
  // The cells go on beyond the window where its size is no multiple of theirs.
  const glm::dvec2 picture(pass.size),
      covered(scan.cell * window.width(), scan.cell * window.height());
  const glm::dvec2 corner(scan.window.x0 - pass.corner.x, scan.window.y0 - pass.corner.y);
  layer_.scale = picture / covered;
  layer_.offset = -corner / covered;
  return &layer_;
}

}  // namespace limpid

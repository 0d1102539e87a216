#include "complete/surface_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "complete/row_heights.h"
#include "complete/rows.h"
#include "complete/sun_sight.h"

namespace limpid {
namespace {

/// Pixels between the corners of a cell of a picture up to 1.5 times as wide as kWide: twice as
/// many of one up to 2.5 times as wide, and so on.
constexpr int kCell = 4;
constexpr double kWide = 1920;
constexpr int kBlock = 4;            ///< pixels of the shadow
constexpr float kUneven = -1;        ///< in the place of a block's shadow
constexpr int kRounds = 5;           ///< until the end of a sun's ray is found
constexpr int kBetween = 4;          ///< places between the water and that end
constexpr double kOneSurface = 0.9;  ///< quotient of depths of neighbours on one surface
constexpr double kSame = 0.01;       ///< depths this much apart are those of one surface
constexpr double kLowestSun = 1e-3;  ///< sine of its elevation

int cell_of(const Rect& window) {
  const int longer = std::max(window.width(), window.height());
  return kCell * std::max(1, static_cast<int>(std::lround(longer / kWide)));
}

/// Where the sun's rays end that pass the water.
class Ends {
 public:
  Ends(const Frame& frame, const Pass& pass)
      : c_(pass),
        depth_(frame.plane(PlaneId::kDepth)),
        shadow_(frame.plane(PlaneId::kShadow)),
        shown_(intersection(depth_.window, shadow_.window)),
        rise_(glm::dot(pass.sun.direction, pass.up)),
        back_u_(-glm::dot(pass.to_u, pass.sun.direction)),
        back_v_(-glm::dot(pass.to_v, pass.sun.direction)),
        back_depth_(-glm::dot(pass.forward, pass.sun.direction)) {}

  struct End {
    double lit, known;
    glm::dvec2 at;  ///< pixels, where `known`
  };
  /// Of the ray through the point at an eye depth on a pixel's ray.
  End of(int x, int y, const RowHeights& heights, double depth) const {
    const double w = c_.w_origin + c_.w_depth * depth;
    const glm::dvec2 from{w * (x - c_.corner.x + 0.5) / c_.size.x,
                          w * (y - c_.corner.y + 0.5) / c_.size.y};
    const double dry = depth_.at(x, y);
    double along = dry < 1e30 ? std::max(-heights.at(x, dry) / rise_, 0.0) : 0;
    const double height = heights.at(x, depth);
    Seen end{};
    double known = 0;
    for (int i = 0; i < kRounds && known < 1; ++i) {
      if (i > 0) along = std::max((height + end.deep) / rise_, 0.0);
      end = seen_at(from, depth, along);
      if (!end.shown || !(end.seen < 1e30)) return {1, 0, {}};
      known = std::clamp(2 - std::abs(end.seen - end.depth) / (kSame * end.depth), 0.0, 1.0);
    }
    for (int i = 1; i <= kBetween && known > 0; ++i) {
      const Seen there = seen_at(from, depth, along * i / (kBetween + 1));
      if (!there.shown || there.seen < (1 - kSame) * there.depth) known = 0;
    }
    return {known > 0 ? lit_at(end.at) : 1, known, end.at};
  }

 private:
  /// What the picture shows at a point.
  struct Seen {
    bool shown;
    glm::dvec2 at;  ///< pixels
    double depth;   ///< of the point
    double seen;    ///< of the surface there
    double deep;    ///< of that surface, below the calm water
  };
  /// At the point `along` behind the water, as seen from the sun. `from`: the uv of the point of
  /// the water times its w.
  Seen seen_at(const glm::dvec2& from, double depth, double along) const {
    Seen there{};
    there.depth = depth + along * back_depth_;
    const double w = c_.w_origin + c_.w_depth * there.depth;
    there.at = {(from.x + along * back_u_) / w * c_.size.x + c_.corner.x,
                (from.y + along * back_v_) / w * c_.size.y + c_.corner.y};
    const Rect& window = shown_;
    there.shown = w > 0 && there.depth > 0 && there.at.x >= window.x0 && there.at.x < window.x1 &&
                  there.at.y >= window.y0 && there.at.y < window.y1;
    if (!there.shown) return there;
    there.seen = depth_at(there.at);
    const double column = there.at.x - c_.corner.x, row = there.at.y - c_.corner.y;
    there.deep = -c_.eye_above - glm::dot(c_.up, c_.rays.origin_at(column, row) +
                                                     there.seen * c_.rays.ray_at(column, row));
    return there;
  }
  /// The four texels around a place, and its position between them.
  struct Quad {
    std::array<double, 4> texels;
    double u, v;
    template <class Value>
    double mean(Value&& value) const {
      return std::lerp(std::lerp(value(texels[0]), value(texels[1]), u),
                       std::lerp(value(texels[2]), value(texels[3]), u), v);
    }
  };
  Quad around(const View<const float>& plane, const glm::dvec2& at) const {
    const double left = std::floor(at.x - 0.5), top = std::floor(at.y - 0.5);
    Quad quad{{}, at.x - 0.5 - left, at.y - 0.5 - top};
    for (int k = 0; k < 4; ++k) {
      const int x = std::clamp(static_cast<int>(left) + (k & 1), shown_.x0, shown_.x1 - 1);
      const int y = std::clamp(static_cast<int>(top) + (k >> 1), shown_.y0, shown_.y1 - 1);
      quad.texels[static_cast<std::size_t>(k)] = plane.at(x, y);
    }
    return quad;
  }
  /// Between texels of one surface, where 1 / depth is linear (in orthographic pictures, depth);
  /// else that of the nearest.
  double depth_at(const glm::dvec2& at) const {
    const Quad quad = around(depth_, at);
    const auto [least, most] = std::minmax_element(quad.texels.begin(), quad.texels.end());
    if (*least > kOneSurface * *most) {
      if (c_.w_depth == 0) return quad.mean([](double depth) { return depth; });
      return 1 / quad.mean([](double depth) { return 1 / depth; });
    }
    return depth_.at(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
  }
  double lit_at(const glm::dvec2& at) const {
    return around(shadow_, at).mean([](double lit) { return lit; });
  }

  const Pass& c_;
  const View<const float>&depth_, &shadow_;
  Rect shown_;
  double rise_, back_u_, back_v_, back_depth_;
};

}  // namespace

void SurfaceShadow::find_even(const View<const float>& shadow, Executor& executor) {
  const Rect& window = shadow.window;
  blocks_ = {(window.width() + kBlock - 1) / kBlock, (window.height() + kBlock - 1) / kBlock};
  even_.resize(static_cast<std::size_t>(blocks_.width) * blocks_.height);
  each_row(executor, {0, 0, 1, blocks_.height}, [&](int row) {
    const int top = window.y0 + row * kBlock, bottom = std::min(top + kBlock, window.y1);
    for (int column = 0; column < blocks_.width; ++column) {
      const int left = window.x0 + column * kBlock, right = std::min(left + kBlock, window.x1);
      const float first = shadow.at(left, top);
      bool even = true;
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) even = even && shadow.at(x, y) == first;
      }
      even_[static_cast<std::size_t>(row) * blocks_.width + column] = even ? first : kUneven;
    }
  });
}

/// Whether the shadow is the same all between the ends of four rays.
bool SurfaceShadow::is_even(const Rect& window, const std::array<const Node*, 4>& corners) const {
  glm::dvec2 low = corners[0]->end, high = low;
  for (const Node* corner : corners) {
    if (corner->known < 1 || corner->lit != corners[0]->lit) return false;
    low = glm::min(low, corner->end), high = glm::max(high, corner->end);
  }
  constexpr int kMost = 16;  // blocks; a cell whose rays end farther apart is looked at closely
  const int left = (static_cast<int>(low.x) - 1 - window.x0) / kBlock,
            top = (static_cast<int>(low.y) - 1 - window.y0) / kBlock,
            right =
                std::min((static_cast<int>(high.x) + 1 - window.x0) / kBlock, blocks_.width - 1),
            bottom =
                std::min((static_cast<int>(high.y) + 1 - window.y0) / kBlock, blocks_.height - 1);
  if (right - left > kMost || bottom - top > kMost) return false;
  for (int row = std::max(top, 0); row <= bottom; ++row) {
    for (int column = std::max(left, 0); column <= right; ++column) {
      const float even = even_[static_cast<std::size_t>(row) * blocks_.width + column];
      if (even != corners[0]->lit) return false;
    }
  }
  return true;
}

void SurfaceShadow::make(const Frame& frame, const Pass& pass, Executor& executor) {
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  const View<const float>& shadow = frame.plane(PlaneId::kShadow);
  const Rect& window = depth.window;
  if (!plane_ || plane_.view().window != window) plane_ = Plane(window);
  const View<float> lit = plane_.view();
  if (!(glm::dot(pass.sun.direction, pass.up) > kLowestSun)) {
    each_row(executor, window, [&](int y) { std::fill_n(lit.row(y), window.width(), 1.0f); });
    return;
  }
  const auto water_at = [&](int x, int y, const RowHeights& heights) {
    const bool own = surface && surface.window.contains(Rect{x, y, x + 1, y + 1});
    const double at = own ? surface.at(x, y) : heights.depth_at(x, 0);
    return at > 0 && at < 1e30 ? at : HUGE_VAL;
  };
  const Ends ends(frame, pass);
  const SunSight sight(depth, pass);
  find_even(shadow, executor);
  const int cell = cell_of(window);
  const int columns = (window.width() + cell - 1) / cell,
            rows = (window.height() + cell - 1) / cell;
  nodes_.resize(static_cast<std::size_t>(columns + 1) * (rows + 1));
  each_row(executor, {0, 0, 1, rows + 1}, [&](int row) {
    const int y = std::min(window.y0 + row * cell, window.y1 - 1);
    const RowHeights heights(pass, y);
    for (int column = 0; column <= columns; ++column) {
      const int x = std::min(window.x0 + column * cell, window.x1 - 1);
      const double water = water_at(x, y, heights);
      Node& node = nodes_[static_cast<std::size_t>(row) * (columns + 1) + column];
      node = {1, 0, {}};
      if (!(water < 1e30)) continue;
      Ends::End end{1, 0, {}};
      if (water < depth.at(x, y)) end = ends.of(x, y, heights, water);
      if (end.known < 1) {
        const double found = 1 - sight.hidden_from_water(x, y, water);
        end.lit = std::lerp(found, end.lit, end.known);
      }
      node = {static_cast<float>(end.lit), static_cast<float>(end.known), end.at};
    }
  });
  each_row(executor, {0, 0, 1, rows}, [&](int row) {
    const int top = window.y0 + row * cell, bottom = std::min(top + cell, window.y1);
    const int high = std::max(std::min(top + cell, window.y1 - 1) - top, 1);  // between corners
    std::vector<RowHeights> of_rows;
    of_rows.reserve(static_cast<std::size_t>(cell));
    for (int y = top; y < bottom; ++y) of_rows.emplace_back(pass, y);
    for (int column = 0; column < columns; ++column) {
      const int left = window.x0 + column * cell, right = std::min(left + cell, window.x1);
      const int wide = std::max(std::min(left + cell, window.x1 - 1) - left, 1);
      const Node* above = &nodes_[static_cast<std::size_t>(row) * (columns + 1) + column];
      const Node* below = above + columns + 1;
      if (is_even(shadow.window, {above, above + 1, below, below + 1})) {
        for (int y = top; y < bottom; ++y)
          std::fill(lit.row(y) + (left - window.x0), lit.row(y) + (right - window.x0), above->lit);
        continue;
      }
      const bool shown =
          std::max({above[0].known, above[1].known, below[0].known, below[1].known}) > 0;
      const float sum = above[0].lit + above[1].lit + below[0].lit + below[1].lit;
      const bool edge = sum > 0 && sum < 4;
      // At the edge of a shadow, a quarter of the cell shares a search.
      std::array<double, 4> searched;
      searched.fill(-1);
      const auto search = [&](int x, int y, double water) {
        const int part = (y - top) / (cell / 2) * 2 + (x - left) / (cell / 2);
        double& found = searched[static_cast<std::size_t>(part)];
        if (found < 0) found = 1 - sight.hidden_from_water(x, y, water);
        return found;
      };
      for (int y = top; y < bottom; ++y) {
        const RowHeights& heights = of_rows[static_cast<std::size_t>(y - top)];
        const float v = static_cast<float>(y - top) / static_cast<float>(high);
        for (int x = left; x < right; ++x) {
          const float u = static_cast<float>(x - left) / static_cast<float>(wide);
          const float between = std::lerp(std::lerp(above[0].lit, above[1].lit, u),
                                          std::lerp(below[0].lit, below[1].lit, u), v);
          const double water = shown || edge ? water_at(x, y, heights) : HUGE_VAL;
          float& to = lit.at(x, y);
          to = between;
          if (!(water < depth.at(x, y))) continue;
          const Ends::End end = shown ? ends.of(x, y, heights, water) : Ends::End{1, 0, {}};
          const double found = end.known < 1 && edge ? search(x, y, water) : between;
          to = static_cast<float>(std::lerp(found, end.lit, end.known));
        }
      }
    }
  });
}

}  // namespace limpid

#include "complete/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "complete/row_heights.h"

namespace limpid {
namespace {

/// Samples of the picture: surfaces over the water, and places on it.
constexpr int kColumns = 96, kRows = 54, kPlaceColumns = 8, kPlaceRows = 8;
/// Directions around a place, and bands of elevation with equal light of an even sky: equal steps
/// of the sine's square.
constexpr int kAround = 32, kBands = 8;
/// What is assumed of directions that the picture does not show.
constexpr double kUnseen = 0.5, kCut = 0.5;

struct Surface {
  glm::dvec2 at;  ///< along WaterView::map_x and map_y
  double height;
  Rgb<double> color;
  bool cut;  ///< at the upper edge of the picture
};

/// A band of elevation in one direction.
struct Band {
  double low = HUGE_VAL, high = -HUGE_VAL;  ///< squared sines of the surfaces
  bool met() const { return high >= low; }
};

/// The light around one place on the water, as shares of all directions.
struct Cover {
  double hidden = 0;           ///< of the sky
  Rgb<double> light{0, 0, 0};  ///< of the surfaces that hide it, times that share
};

class Picture {
 public:
  Picture(const Frame& frame, const Pass& c)
      : c_(c), depth_(frame.plane(PlaneId::kDepth)), surface_(frame.plane(PlaneId::kSurfaceDepth)) {
    window_ = intersection(frame.work(), depth_.window);
    if (surface_) window_ = intersection(window_, surface_.window);
    for (int i = 0; i < 3; ++i) {
      color_[i] = frame.plane(plane_after(PlaneId::kColorR, i));
      window_ = intersection(window_, color_[i].window);
    }
    if (!window_.empty()) gather();
    for (int i = 0; i < kAround; ++i) shows_[static_cast<std::size_t>(i)] = is_in_view(i);
  }

  /// The mean over all places; nothing hidden if there are none.
  Cover mean(double closed) const {
    Cover sum;
    for (const glm::dvec2& place : places_) {
      const Cover one = cover_at(place, closed);
      sum.hidden += one.hidden;
      sum.light = sum.light + one.light;
    }
    const double per_place = places_.empty() ? 0 : 1.0 / static_cast<double>(places_.size());
    return {per_place * sum.hidden, per_place * sum.light};
  }

 private:
  void gather() {
    const auto each = [&](int columns, int rows, const auto& visit) {
      for (int j = 0; j < rows; ++j) {
        const int y = window_.y0 + (2 * j + 1) * window_.height() / (2 * rows);
        const RowHeights heights(c_, y);
        for (int i = 0; i < columns; ++i) {
          visit(heights, window_.x0 + (2 * i + 1) * window_.width() / (2 * columns), y, j);
        }
      }
    };
    each(kColumns, kRows, [&](const RowHeights& heights, int x, int y, int j) {
      const double depth = depth_.at(x, y);
      const double height = depth < 1e30 ? heights.at(x, depth) : 0;
      if (!(height > 0) || water_at(heights, x, y) < depth) return;
      const auto light = [&](int i) {
        const double value = color_[i].at(x, y);
        return value > 0 && value < 1e30 ? value : 0;
      };
      surfaces_.push_back({level_at(x, y, depth), height, {light(0), light(1), light(2)}, j == 0});
    });
    each(kPlaceColumns, kPlaceRows, [&](const RowHeights& heights, int x, int y, int) {
      const double water = water_at(heights, x, y);
      if (water < 1e30 && water < depth_.at(x, y)) places_.push_back(level_at(x, y, water));
    });
  }
  /// Eye depth of the water, +inf where there is none.
  double water_at(const RowHeights& heights, int x, int y) const {
    const double water = surface_ ? surface_.at(x, y) : heights.depth_at(x, 0);
    return water > 0 ? water : HUGE_VAL;
  }
  glm::dvec2 level_at(int x, int y, double depth) const {
    const double column = x - c_.corner.x + 0.5, row = y - c_.corner.y + 0.5;
    const glm::dvec3 p = c_.rays.origin_at(column, row) + depth * c_.rays.ray_at(column, row);
    return {glm::dot(c_.map_x, p), glm::dot(c_.map_y, p)};
  }

  /// Whether the picture shows the horizon in a direction.
  bool is_in_view(int direction) const {
    const double angle = 2 * std::numbers::pi * (direction + 0.5) / kAround;
    const glm::dvec3 to = std::cos(angle) * c_.map_x + std::sin(angle) * c_.map_y;
    const double w = c_.w_depth * glm::dot(c_.forward, to);
    const auto within = [&](const glm::dvec3& axis) {
      const double at = glm::dot(axis, to) / w;
      return at >= 0 && at <= 1;
    };
    return w > 0 && within(c_.to_u) && within(c_.to_v);
  }

  Cover cover_at(const glm::dvec2& place, double closed) const {
    std::array<std::array<Band, kBands>, kAround> bands{};
    std::array<Rgb<double>, kAround> light{};
    std::array<double, kAround> count{}, cut{};
    for (const Surface& s : surfaces_) {
      const glm::dvec2 off = s.at - place;
      const double level = glm::dot(off, off), square = s.height * s.height;
      if (!(level > 0)) continue;
      const double sine = square / (square + level);
      const double turn = std::atan2(off.y, off.x) / (2 * std::numbers::pi);
      const auto direction = static_cast<std::size_t>(
          std::clamp(static_cast<int>((turn - std::floor(turn)) * kAround), 0, kAround - 1));
      Band& band =
          bands[direction]
               [static_cast<std::size_t>(std::min(static_cast<int>(sine * kBands), kBands - 1))];
      band.low = std::min(band.low, sine), band.high = std::max(band.high, sine);
      light[direction] = light[direction] + s.color;
      count[direction] += 1;
      if (s.cut) cut[direction] = std::max(cut[direction], sine);
    }
    Cover known, sum;
    double shown = 0;
    for (std::size_t i = 0; i < kAround; ++i) {
      if (!(count[i] > 0 || shows_[i])) continue;
      shown += 1;
      double hidden = hidden_of(bands[i]);
      if (cut[i] > 0) hidden += (kCut + (1 - kCut) * closed) * (1 - cut[i]);
      known.hidden += hidden;
      if (count[i] > 0) known.light = known.light + (hidden / count[i]) * light[i];
    }
    if (!(shown > 0)) return {};
    const double per_direction = 1.0 / kAround;
    sum.hidden = per_direction * known.hidden, sum.light = per_direction * known.light;
    if (!(known.hidden > 0)) return sum;
    // Elsewhere the surroundings are as bright.
    const double mean = known.hidden / shown, unseen = per_direction * (kAround - shown);
    const double more = unseen * (kUnseen * mean + closed * (1 - kUnseen * mean));
    sum.light = sum.light + (more / known.hidden) * known.light;
    sum.hidden += more;
    return sum;
  }

  /// The share of a direction's light that its surfaces hide: they go on to the next band if this
  /// shows surfaces, too, and the lowest band goes on to the water.
  static double hidden_of(const std::array<Band, kBands>& bands) {
    double hidden = 0;
    for (std::size_t b = 0; b < kBands; ++b) {
      if (!bands[b].met()) continue;
      const bool under = b == 0 || bands[b - 1].met(), over = b + 1 < kBands && bands[b + 1].met();
      const double low = under ? static_cast<double>(b) / kBands : bands[b].low;
      const double high = over ? static_cast<double>(b + 1) / kBands : bands[b].high;
      hidden += high - low;
    }
    return hidden;
  }

  const Pass& c_;
  View<const float> depth_, surface_;
  View<const float> color_[3];
  Rect window_;
  std::vector<Surface> surfaces_;
  std::vector<glm::dvec2> places_;
  std::array<bool, kAround> shows_{};
};

}  // namespace

Rgb<double> surroundings(const Frame& frame, const Pass& pass, const Rgb<double>& sky,
                         double closed) {
  if (!(pass.eye_above > 0) || !frame.plane(PlaneId::kDepth)) return sky;
  for (int i = 0; i < 3; ++i) {
    if (!frame.plane(plane_after(PlaneId::kColorR, i))) return sky;
  }
  const Cover cover = Picture(frame, pass).mean(closed);
  return (1 - cover.hidden) * sky + cover.light;
}

}  // namespace limpid

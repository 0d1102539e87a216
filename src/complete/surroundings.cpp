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
constexpr int kColumns = 96, kRows = 54, kPlaceColumns = 6, kPlaceRows = 6;
/// Directions around a place, and bands of elevation with equal light of an even sky: equal steps
/// of the sine's square.
constexpr int kAround = 32, kBands = 8;
/// What is assumed of directions that the picture does not show.
constexpr double kUnseen = 0.5, kCut = 0.5;

struct Surface {
  glm::dvec2 at;         ///< along WaterView::map_x and map_y
  double height, width;  ///< width of the sample across the view
  Rgb<double> color;
  bool cut;  ///< at the upper edge of the picture
};

/// A band of elevation in one direction.
struct Band {
  double low = HUGE_VAL, high = -HUGE_VAL;  ///< squared sines of the surfaces
  bool met() const { return high >= low; }
};

/// The surfaces in one direction.
struct Sector {
  std::array<Band, kBands> bands{};
  Rgb<double> light{0, 0, 0};
  double count = 0, cut = 0;               ///< cut: the highest squared sine of a cut surface
  double first = 1, last = 0, widths = 0;  ///< in shares of the sector
  bool horizon = false, water = false;     ///< whether the picture shows them there

  /// The share of the directions of the sector that its surfaces fill.
  double filled() const {
    return count > 0 ? std::clamp(last - first + widths / count, 0.0, 1.0) : 0;
  }
  /// The share of the light of these directions that they hide: they go on to the next band if this
  /// shows surfaces, too, and the lowest band goes on to the water.
  double hidden(double closed) const {
    double sum = 0;
    for (std::size_t b = 0; b < kBands; ++b) {
      if (!bands[b].met()) continue;
      const bool under = b == 0 || bands[b - 1].met(), over = b + 1 < kBands && bands[b + 1].met();
      const double low = under ? static_cast<double>(b) / kBands : bands[b].low;
      const double high = over ? static_cast<double>(b + 1) / kBands : bands[b].high;
      sum += high - low;
    }
    sum = std::clamp(sum, 0.0, 1.0);
    return cut > 0 ? sum + (kCut + (1 - kCut) * closed) * std::min(1 - sum, 1 - cut) : sum;
  }
};

/// The light around one place on the water, as shares of all directions.
struct Cover {
  double hidden = 0;           ///< of the sky, at most 1
  Rgb<double> light{0, 0, 0};  ///< of the surfaces that hide it, times that share
};

class Picture {
 public:
  Picture(const Frame& frame, const Pass& c)
      : c_(c), depth_(frame.plane(PlaneId::kDepth)), surface_(frame.plane(PlaneId::kSurfaceDepth)) {
    window_ = intersection(frame.work(), depth_.window);
    for (int i = 0; i < 3; ++i) {
      color_[i] = frame.plane(plane_after(PlaneId::kColorR, i));
      window_ = intersection(window_, color_[i].window);
    }
    if (!window_.empty()) gather();
    for (int i = 0; i < kAround; ++i) shows_[static_cast<std::size_t>(i)] = is_in_view(i);
  }

  /// The mean over all places; nothing hidden if there are none.
  Cover mean(double closed, Executor& executor) const {
    std::vector<Cover> covers(places_.size());
    run_each(executor, static_cast<int>(places_.size()), [&](int i) {
      const auto place = static_cast<std::size_t>(i);
      covers[place] = cover_at(places_[place], closed);
    });
    Cover sum;
    for (const Cover& one : covers) {
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
      const double height = depth > 0 && depth < 1e30 ? heights.at(x, depth) : 0;
      if (!(height > 0) || water_at(heights, x, y) < depth) return;
      const auto light = [&](int i) {
        const double value = color_[i].at(x, y);
        return value > 0 && value < 1e30 ? value : 0;
      };
      const double pixels = static_cast<double>(window_.width()) / kColumns;
      const double width = pixels * glm::length(c_.rays.origin_dx + depth * c_.rays.ray_dx);
      surfaces_.push_back(
          {level_at(x, y, depth), height, width, {light(0), light(1), light(2)}, j == 0});
    });
    each(kPlaceColumns, kPlaceRows, [&](const RowHeights& heights, int x, int y, int) {
      const double water = water_at(heights, x, y);
      if (water < 1e30 && water < depth_.at(x, y)) places_.push_back(level_at(x, y, water));
    });
  }
  /// Eye depth of the water, +inf where there is none.
  double water_at(const RowHeights& heights, int x, int y) const {
    const bool known = surface_ && surface_.window.contains({x, y, x + 1, y + 1});
    const double water = known ? surface_.at(x, y) : heights.depth_at(x, 0);
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

  /// A direction in sectors: 0 ... kAround.
  static double turn_to(const glm::dvec2& off) {
    const double turn = std::atan2(off.y, off.x) / (2 * std::numbers::pi);
    return std::clamp((turn - std::floor(turn)) * kAround, 0.0, kAround * (1 - 1e-9));
  }

  Cover cover_at(const glm::dvec2& place, double closed) const {
    std::array<Sector, kAround> sectors{};
    for (std::size_t i = 0; i < kAround; ++i) sectors[i].horizon = shows_[i];
    for (const glm::dvec2& other : places_) {
      sectors[static_cast<std::size_t>(turn_to(other - place))].water = true;
    }
    for (const Surface& s : surfaces_) {
      const glm::dvec2 off = s.at - place;
      const double level = glm::dot(off, off), square = s.height * s.height;
      if (!(level > 0)) continue;
      const double sine = square / (square + level), turn = turn_to(off);
      Sector& sector = sectors[static_cast<std::size_t>(turn)];
      Band& band = sector.bands[static_cast<std::size_t>(std::min(int(sine * kBands), kBands - 1))];
      band.low = std::min(band.low, sine), band.high = std::max(band.high, sine);
      const double at = turn - std::floor(turn);
      sector.first = std::min(sector.first, at), sector.last = std::max(sector.last, at);
      sector.widths += s.width / std::sqrt(level) * (kAround / (2 * std::numbers::pi));
      sector.light = sector.light + s.color;
      sector.count += 1;
      if (s.cut) sector.cut = std::max(sector.cut, sine);
    }
    Cover known;
    double shown = 0, open = 0;  // sectors with a surface, the horizon or water; with water alone
    for (const Sector& sector : sectors) {
      const bool known_end = sector.count > 0 || sector.horizon;
      shown += known_end || sector.water, open += !known_end && sector.water;
      if (!(sector.count > 0)) continue;
      const double hidden = sector.filled() * sector.hidden(closed);
      known.hidden += hidden;
      known.light = known.light + (hidden / sector.count) * sector.light;
    }
    if (!(known.hidden > 0)) return {};
    // Elsewhere the surroundings are as bright.
    const double usual = kUnseen * known.hidden / shown;
    const double unseen = (kAround - shown) * (usual + closed * (1 - usual)) + open * closed;
    const double all = std::min((known.hidden + unseen) / kAround, 1.0);
    return {all, (all / known.hidden) * known.light};
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
                         double closed, Executor& executor) {
  if (!(pass.eye_above > 0) || !frame.plane(PlaneId::kDepth)) return sky;
  for (int i = 0; i < 3; ++i) {
    if (!frame.plane(plane_after(PlaneId::kColorR, i))) return sky;
  }
  const Cover cover = Picture(frame, pass).mean(closed, executor);
  return (1 - cover.hidden) * sky + cover.light;
}

}  // namespace limpid

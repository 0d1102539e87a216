#include "complete/plate_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include "complete/row_heights.h"

namespace limpid {
namespace {

constexpr int kMaxAcross = 64;     ///< sampled pixels per row, and sampled rows
constexpr double kLeastUp = 0.05;  ///< limits slopes to 20
/// Mean height of the waves over the eye's: up to the first value they tilt a plane, from the
/// second on they raise it.
constexpr double kPlane = 1.0 / 2000, kRaised = 4 * kPlane;
constexpr double kMaxTurn = 1e6;  ///< its square is finite in a float, times that of a footprint

/// Where a wet pixel sees the water, in scene units along the axes of the map, and its slopes.
struct Seen {
  glm::dvec2 place, slope;
  double fall;  ///< sine of the angle of the view to the surface
};

class Surface {
 public:
  Surface(const Frame& frame, const WaterView& view)
      : view_(view),
        dry_(frame.plane(PlaneId::kDepth)),
        depth_(frame.plane(PlaneId::kSurfaceDepth)),
        normal_{frame.plane(PlaneId::kSurfaceNormalX), frame.plane(PlaneId::kSurfaceNormalY),
                frame.plane(PlaneId::kSurfaceNormalZ)} {
    window_ = intersection(dry_.window, frame.display);
    if (depth_) window_ = intersection(window_, depth_.window);
    for (const View<const float>& plane : normal_) {
      if (plane) window_ = intersection(window_, plane.window);
    }
  }

  const Rect& window() const { return window_; }
  bool leans() const { return normal_[0] && normal_[1] && normal_[2]; }

  /// Eye depth of the water, +inf where the pixel is dry.
  double depth(int x, int y) const {
    const RowHeights heights(view_, y);
    const double water = depth_ ? depth_.at(x, y) : heights.depth_at(x, 0);
    return water > 0 && water < dry_.at(x, y) && water < 1e30 ? water : HUGE_VAL;
  }

  std::optional<Seen> at(int x, int y) const {
    const double water = depth(x, y);
    if (!std::isfinite(water)) return std::nullopt;
    const double column = x - view_.corner.x + 0.5, row = y - view_.corner.y + 0.5;
    const glm::dvec3 ray = view_.rays.ray_at(column, row);
    const glm::dvec3 point = view_.rays.origin_at(column, row) + water * ray;
    const glm::dvec3 n(normal_[0].at(x, y), normal_[1].at(x, y), normal_[2].at(x, y));
    const double per_up = -1 / std::max(glm::dot(n, view_.up), kLeastUp);
    return Seen{{glm::dot(view_.map_x, point), glm::dot(view_.map_y, point)},
                {per_up * glm::dot(n, view_.map_x), per_up * glm::dot(n, view_.map_y)},
                std::abs(glm::dot(view_.up, glm::normalize(ray)))};
  }

 private:
  const WaterView& view_;
  View<const float> dry_, depth_, normal_[3];
  Rect window_;
};

/// A weighted mean of the outer products of vectors with themselves.
struct Products {
  Sym2<double> sum{0, 0, 0};
  double weight = 0;

  void add(double by, glm::dvec2 v) {
    sum = sum + by * Sym2<double>{v.x * v.x, v.x * v.y, v.y * v.y};
  }
  Sym2<double> mean() const { return weight > 0 ? (1 / weight) * sum : Sym2<double>{0, 0, 0}; }
};

/// What far pixels have in common with the pixels below them: PlateWaves::smooth.
class Neighbours {
 public:
  explicit Neighbours(const Sym2<double>& turn) : turn_(turn) {}

  void add(const Seen& pixel, const Seen& below) {
    const glm::dvec2 step = below.place - pixel.place;
    const double x = along(turn_, Vec2<double>{step.x, step.y});
    if (!(x > kFar)) return;
    const int nth = static_cast<int>(kPerOctave * std::log2(x / kFar));
    counts_[static_cast<std::size_t>(std::min(nth, kBins - 1))] += 1;
    count_ += 1;
    mean_ += 0.5 * (pixel.slope + below.slope);
    const glm::dvec2 change = below.slope - pixel.slope;
    differ_ += glm::dot(change, change);
    square_ += glm::dot(pixel.slope, pixel.slope) + glm::dot(below.slope, below.slope);
  }

  double smooth() const {
    constexpr double kEnough = 64;  // what fewer pixels have in common is chance
    constexpr int kHalvings = 16;
    const double trust = std::clamp(count_ / kEnough - 1, 0.0, 1.0);
    if (trust == 0) return 0;
    const double vary = square_ - 2 * glm::dot(mean_, mean_) / count_;
    const double common = vary > 0 ? 1 - differ_ / vary : 0;
    double least = 0, most = 1;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (least + most);
      (expected(middle) < common ? least : most) = middle;
    }
    return trust * least;
  }

 private:
  static constexpr double kFar = 4;  ///< of x = r' turn r, where waves have turned
  static constexpr int kPerOctave = 4, kBins = 100;

  /// In the mean over a footprint 1 / (1 + x) is left of the variance, so of that at a place r away
  /// 1 / (1 + x / 2).
  double expected(double smooth) const {
    double sum = 0;
    for (int i = 0; i < kBins; ++i) {
      const double x = kFar * std::exp2((i + 0.5) / kPerOctave);
      sum += counts_[static_cast<std::size_t>(i)] / (1 + 0.5 * x / (1 + smooth * x));
    }
    return sum / count_;
  }

  const Sym2<double>& turn_;
  std::array<double, kBins> counts_{};
  double count_ = 0, differ_ = 0, square_ = 0;
  glm::dvec2 mean_{0};  ///< times count_
};

}  // namespace

PlateWaves plate_waves_of(const Frame& frame, const WaterView& view) {
  const Surface surface(frame, view);
  const Rect& window = surface.window();
  const int across = std::max(1, window.width() / kMaxAcross);
  const int down = std::max(1, window.height() / kMaxAcross);
  Products slopes, turns;
  double heights = 0, count = 0;
  for (int y = window.y0; y + 1 < window.y1; y += down) {
    const RowHeights row(view, y);
    for (int x = window.x0; x + 1 < window.x1; x += across) {
      const double depth = surface.depth(x, y);
      if (!std::isfinite(depth)) continue;
      heights += std::abs(row.at(x, depth));
      ++count;
      if (!surface.leans()) continue;
      const std::optional<Seen> here = surface.at(x, y);
      const std::optional<Seen> right = surface.at(x + 1, y), below = surface.at(x, y + 1);
      const double weight = here->fall * here->fall;
      slopes.add(weight, here->slope);
      slopes.weight += weight;
      if (!right || !below) continue;
      const glm::dmat2 steps(right->place - here->place, below->place - here->place);
      const double longest = std::max(glm::length(steps[0]), glm::length(steps[1]));
      if (!(std::abs(glm::determinant(steps)) > 1e-9 * longest * longest)) continue;
      const glm::dmat2 changes(right->slope - here->slope, below->slope - here->slope);
      const glm::dmat2 per_unit = glm::transpose(changes * glm::inverse(steps));
      const double small = 1 / (longest * longest);
      turns.add(small, per_unit[0]);
      turns.add(small, per_unit[1]);
      turns.weight += small;
    }
  }
  PlateWaves waves;
  const double eye = count * std::abs(view.eye_above);
  if (eye > 0) waves.raised = std::clamp((heights / eye - kPlane) / (kRaised - kPlane), 0.0, 1.0);
  waves.variance = slopes.mean();
  const double whole = waves.variance.xx + waves.variance.yy;
  if (!(whole > 1e-12)) return waves;
  waves.turn = (1 / whole) * turns.mean();
  const double most = waves.turn.xx + waves.turn.yy;
  if (most > kMaxTurn) waves.turn = (kMaxTurn / most) * waves.turn;
  Neighbours neighbours(waves.turn);
  for (int y = window.y0; y + 1 < window.y1; y += down) {
    for (int x = window.x0; x + 1 < window.x1; x += across) {
      const std::optional<Seen> here = surface.at(x, y), below = surface.at(x, y + 1);
      if (here && below) neighbours.add(*here, *below);
    }
  }
  waves.smooth = neighbours.smooth();
  return waves;
}

PlateWaves plate_waves_of_sines(const WaterView& view) {
  PlateWaves waves;
  waves.raised = 1;
  Products slopes, turns;
  for (const SineWave& wave : view.waves) {
    const double a = view.wave_scale * wave.amplitude;
    const glm::dvec2 k(wave.k_x, wave.k_y);
    slopes.add(0.5 * a * a, k);
    turns.add(0.5 * a * a * glm::dot(k, k), k);
  }
  waves.variance = slopes.sum;
  turns.weight = waves.variance.xx + waves.variance.yy;
  waves.turn = turns.mean();
  const double most = waves.turn.xx + waves.turn.yy;
  if (most > kMaxTurn) waves.turn = (kMaxTurn / most) * waves.turn;
  return waves;
}

}  // namespace limpid

#include "complete/basin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limpid {
namespace {

constexpr int kDirections = 8;
/// Distances at which walls are searched, in depths of the bottom.
constexpr std::array<double, Basin::kRings> kLooks{0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 8, 11, 16};
/// A wall lies nearer than this, in depths, to the place at which it is searched; a farther surface
/// is an unrelated object in front of that place in the picture.
constexpr double kNear = 1.5;
constexpr int kHalvings = 3;
constexpr double kTexels = 1e-3;  ///< error of a plane, as a share of depth

/// Distance of a ring's walls, in depths.
double middle_of(std::size_t ring) {
  return 0.5 * ((ring > 0 ? kLooks[ring - 1] : 0) + kLooks[ring]);
}

/// Square of the sine of light's upward direction that comes down this many depths away.
double square_at(double distance) {
  const double tangent = distance / 2;
  return tangent * tangent / (1 + tangent * tangent);
}

}  // namespace

/// The surface that the picture shows at a point, `by` from a place. `near`: how far from it, over
/// the plane of the water, a dry surface may lie.
Basin::Shown Basin::at(const Place& place, const glm::dvec3& by, double near) const {
  const double z = place.z + glm::dot(c_.forward, by), w = c_.w_origin + c_.w_depth * z;
  if (!(w > 0)) return Shown::kOutside;
  const glm::dvec2 from = (c_.w_origin + c_.w_depth * place.z) * place.uv;
  const double column = (from.x + glm::dot(c_.to_u, by)) / w * c_.size.x;
  const double row = (from.y + glm::dot(c_.to_v, by)) / w * c_.size.y;
  const double x = std::floor(column) + c_.corner.x, y = std::floor(row) + c_.corner.y;
  const Rect& window = depth_.window;
  if (!(x >= window.x0 && x < window.x1 && y >= window.y0 && y < window.y1)) {
    return Shown::kOutside;
  }
  const double seen = depth_.at(static_cast<int>(x), static_cast<int>(y));
  if (!(seen < (1 - kTexels) * z)) return Shown::kWater;
  const glm::dvec3 off =
      c_.rays.origin_at(column, row) + seen * c_.rays.ray_at(column, row) - (place.at + by);
  const glm::dvec3 level = off - glm::dot(off, c_.up) * c_.up;
  return glm::length(level) < near ? Shown::kDry : Shown::kUnknown;
}

Basin::Walls Basin::around(int x, int y) const {
  Walls walls{};
  const double column = x + 0.5 - c_.corner.x, row = y + 0.5 - c_.corner.y;
  const double z = depth_.at(x, y);
  const Place bottom{c_.rays.origin_at(column, row) + z * c_.rays.ray_at(column, row),
                     {column / c_.size.x, row / c_.size.y},
                     z};
  const double drop = -(c_.eye_above + glm::dot(c_.up, bottom.at));
  if (!(drop > 0)) return walls;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = (k + 0.5) * (2 * std::numbers::pi / kDirections);
    const glm::dvec3 along = std::cos(angle) * c_.t + std::sin(angle) * c_.b;
    const auto shown_at = [&](double distance) {
      return at(bottom, drop * (c_.up + distance * along), kNear * drop);
    };
    double before = 0;
    for (std::size_t ring = 0; ring < kRings; ++ring) {
      const Shown shown = shown_at(kLooks[ring]);
      if (shown == Shown::kOutside) break;
      if (shown == Shown::kWater) before = kLooks[ring];
      if (shown != Shown::kDry) continue;
      double shore = kLooks[ring];
      for (int i = 0; i < kHalvings; ++i) {
        const double between = 0.5 * (before + shore);
        (shown_at(between) == Shown::kWater ? before : shore) = between;
      }
      // On a beach the bottom continues up to the shore.
      const double foot = std::max(before - 0.5, 0.0);
      if (at(bottom, drop * (foot * along + 0.5 * c_.up), 0) == Shown::kWater) {
        walls[ring] += 1.0f / kDirections;
      }
      break;
    }
  }
  return walls;
}

double Basin::thrown_on(const Walls& walls, double depth, double ior) {
  const double whole = 1 / (ior * ior);  // beyond it, total reflection
  double beyond = 0, sum = 0;
  for (std::size_t ring = kRings; ring-- > 0;) {
    // Light that comes down between the walls of this ring and of the next.
    const double from = std::max(square_at(middle_of(ring)), whole);
    const double to = ring + 1 < kRings ? std::max(square_at(middle_of(ring + 1)), whole) : 1;
    const double cosine = std::sqrt(std::max(1 - 0.5 * (from + to), 1e-6));
    beyond += (to - from) * std::exp(-2 * depth / cosine);
    sum += walls[ring] * beyond;
  }
  return sum;
}

}  // namespace limpid

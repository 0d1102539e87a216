#include "complete/basin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limpid {
namespace {

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

double level_size(const glm::dvec3& by, const glm::dvec3& up) {
  return glm::length(by - glm::dot(by, up) * up);
}

/// Of a point, relative to the eye.
double drop_of(const glm::dvec3& at, const Pass& c) { return -(c.eye_above + glm::dot(c.up, at)); }

}  // namespace

Basin::Basin(const Frame& frame, const Pass& pass)
    : c_(pass), depth_(frame.plane(PlaneId::kDepth)) {
  for (std::size_t k = 0; k < kDirections; ++k) {
    const double angle = (static_cast<double>(k) + 0.5) * (2 * std::numbers::pi / kDirections);
    directions_[k] = std::cos(angle) * c_.t + std::sin(angle) * c_.b;
  }
}

std::optional<Basin::Sight> Basin::look(const Place& place, const glm::dvec3& by) const {
  const double z = place.z + glm::dot(c_.forward, by), w = c_.w_origin + c_.w_depth * z;
  if (!(w > 0)) return {};
  const glm::dvec2 from = (c_.w_origin + c_.w_depth * place.z) * place.uv;
  const double column = (from.x + glm::dot(c_.to_u, by)) / w * c_.size.x;
  const double row = (from.y + glm::dot(c_.to_v, by)) / w * c_.size.y;
  const double x = std::floor(column) + c_.corner.x, y = std::floor(row) + c_.corner.y;
  const Rect& window = depth_.window;
  if (!(x >= window.x0 && x < window.x1 && y >= window.y0 && y < window.y1)) return {};
  const int px = static_cast<int>(x), py = static_cast<int>(y);
  const double seen = depth_.at(px, py);
  return Sight{
      px, py, z, seen,
      c_.rays.origin_at(column, row) + seen * c_.rays.ray_at(column, row) - (place.at + by)};
}

/// The surface that the picture shows at a point, `by` from a place. `near`: how far from it, over
/// the plane of the water, a dry surface may lie.
Basin::Shown Basin::at(const Place& place, const glm::dvec3& by, double near) const {
  const auto sight = look(place, by);
  if (!sight) return Shown::kOutside;
  if (!(sight->seen < (1 - kTexels) * sight->z)) return Shown::kWater;
  return level_size(sight->off, c_.up) < near ? Shown::kDry : Shown::kUnknown;
}

/// The point under water that a pixel shows, if any.
std::optional<Basin::Place> Basin::place_of(int x, int y) const {
  const double column = x + 0.5 - c_.corner.x, row = y + 0.5 - c_.corner.y;
  const double z = depth_.at(x, y);
  const Place place{c_.rays.origin_at(column, row) + z * c_.rays.ray_at(column, row),
                    {column / c_.size.x, row / c_.size.y},
                    z};
  if (!(drop_of(place.at, c_) > 0)) return {};
  return place;
}

Basin::Walls Basin::walls_around(int x, int y) const {
  Walls walls{};
  const auto bottom = place_of(x, y);
  if (!bottom) return walls;
  const double drop = drop_of(bottom->at, c_);
  for (const glm::dvec3& along : directions_) {
    const auto shown_at = [&](double distance) {
      return at(*bottom, drop * (c_.up + distance * along), kNear * drop);
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
      if (at(*bottom, drop * (foot * along + 0.5 * c_.up), 0) == Shown::kWater) {
        walls[ring] += 1.0f / kDirections;
      }
      break;
    }
  }
  return walls;
}

Basin::Floor Basin::floor_around(int x, int y, const Lit& lit) const {
  Floor floor;
  const auto bottom = place_of(x, y);
  if (!bottom) return floor;
  const double drop = drop_of(bottom->at, c_);
  for (const glm::dvec3& along : directions_) {
    for (std::size_t ring = 0; ring < kRings; ++ring) {
      const glm::dvec3 by = (drop * kLooks[ring]) * along;
      const auto sight = look(*bottom, by);
      if (!sight) break;
      if (!(level_size(sight->off, c_.up) < kNear * drop)) continue;
      if (!(drop_of(bottom->at + by + sight->off, c_) > 0)) break;  // the shore
      const std::optional<float> there = lit(sight->x, sight->y);
      if (there) floor.seen[ring] += 1, floor.sunlit[ring] += *there;
    }
  }
  return floor;
}

Basin::Reflected Basin::reflected(double depth, double ior) {
  const double whole = 1 / (ior * ior);  // beyond it, total reflection
  const auto square_beyond = [&](std::size_t ring) {
    return ring < kRings ? std::max(square_at(middle_of(ring)), whole) : 1;
  };
  Reflected light;
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    const double from = square_beyond(ring), to = square_beyond(ring + 1);
    const double cosine = std::sqrt(std::max(1 - 0.5 * (from + to), 1e-6));
    light[ring] = (to - from) * std::exp(-2 * depth / cosine);
  }
  return light;
}

double Basin::share_on(const Walls& walls, const Reflected& light) {
  double beyond = 0, sum = 0;
  for (std::size_t ring = kRings; ring-- > 0;) {
    beyond += light[ring];
    sum += walls[ring] * beyond;
  }
  return sum;
}

double Basin::share_sunlit(const Floor& floor, const Reflected& light) {
  double sunlit = 0, all = 0;
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    sunlit += light[ring] * floor.sunlit[ring], all += light[ring] * floor.seen[ring];
  }
  return all > 0 ? sunlit / all : 1;
}

}  // namespace limpid

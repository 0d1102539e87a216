#pragma once
#include <algorithm>

#include "core/water_view.h"
#include "judge/trace/medium.h"
#include "judge/trace/solid.h"
#include "optics/absorption.h"

namespace limpid::trace {

/// The path of sunlight down to points of the water and of the bottom, through the calm plane.
class SunPath {
 public:
  /// `to_sun`: in the air, unit.
  SunPath(const WaterView& view, const Solid& solid, const Medium& medium, const glm::dvec3& to_sun)
      : view_(view), solid_(solid), medium_(medium), to_sun_(to_sun) {}

  /// Depth below the calm plane; the second function clamps it to 0.
  double under_calm(const glm::dvec3& point) const {
    return -view_.eye_above - glm::dot(view_.up, point);
  }
  double depth_of(const glm::dvec3& point) const { return std::max(0.0, under_calm(point)); }

  /// Whether the sun reaches a point in the water, or of the bottom, for this band.
  bool reaches(const glm::dvec3& point, const Band& band) const {
    const double depth = depth_of(point);
    Ray up{point, band.light.to_sun};
    if (!medium_.bends_sun || depth <= 0) {
      up.direction = to_sun_;
      return !solid_.blocks(up);
    }
    up.to = depth / glm::dot(band.light.to_sun, view_.up);
    return !solid_.blocks(up) && !solid_.blocks({up.at(up.to), to_sun_});
  }

  /// Share of sunlight left at a point that it reaches, after absorption and scattering. Only for a
  /// sun above the horizon.
  Rgb<double> left_at(const glm::dvec3& point, const Band& band) const {
    const double rise = glm::dot(band.light.to_sun, view_.up);
    return transmittance(depth_of(point) / rise, medium_.rate);
  }

 private:
  const WaterView& view_;
  const Solid& solid_;
  const Medium& medium_;
  glm::dvec3 to_sun_;
};

}  // namespace limpid::trace

#include "plan/survey_scan.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "limpid/core/simd.h"

namespace limpid {

// One for each instruction set that the build names, defined in survey_target.cpp.
#define LIMPID_TARGET(name, highway) extern const ScanTarget kScan_##name;
#include "core/targets.inc"
#undef LIMPID_TARGET

namespace {

constexpr const ScanTarget* kTargets[] = {
#define LIMPID_TARGET(name, highway) &kScan_##name,
#include "core/targets.inc"
#undef LIMPID_TARGET
};

}  // namespace

const ScanTarget& scan_target(const std::string& simd) { return *kTargets[simd_index(simd)]; }

/// A few roundings of each term.
HeightError calm_error(const WaterView& c) {
  const auto most = [&](const glm::dvec3& at, const glm::dvec3& dx, const glm::dvec3& dy) {
    return std::abs(glm::dot(c.up, at)) + 4 * c.size.x * std::abs(glm::dot(c.up, dx)) +
           4 * c.size.y * std::abs(glm::dot(c.up, dy));
  };
  const Rays& r = c.rays;
  return {
      static_cast<float>(1e-6 * (std::abs(c.eye_above) + most(r.origin, r.origin_dx, r.origin_dy))),
      static_cast<float>(1e-6 * most(r.ray, r.ray_dx, r.ray_dy))};
}

}  // namespace limpid

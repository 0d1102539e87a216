#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

/// Random directions, from numbers in 0 ... 1. All are unit.

namespace limpid::trace {

/// The direction at an angle of that cosine from `axis`, rotated around it by `turn` (in turns).
/// Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
inline glm::dvec3 around(const glm::dvec3& axis, double cosine, double turn) {
  const double sign = std::copysign(1.0, axis.z), a = -1 / (sign + axis.z), b = axis.x * axis.y * a;
  const glm::dvec3 first(1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x);
  const glm::dvec3 second(b, sign + axis.y * axis.y * a, -axis.y);
  const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
  const double angle = 2 * std::numbers::pi * turn;
  return glm::normalize(sine * std::cos(angle) * first + sine * std::sin(angle) * second +
                        cosine * axis);
}

/// With a density of the cosine to the normal, as a Lambert surface reflects.
inline glm::dvec3 diffuse_direction(const glm::dvec3& normal, double u, double turn) {
  return around(normal, std::sqrt(u), turn);
}

/// With the density henyey_greenstein() of the angle to `ahead`.
inline glm::dvec3 scattered_direction(const glm::dvec3& ahead, double g, double u, double turn) {
  if (std::abs(g) < 1e-4) return around(ahead, 2 * u - 1, turn);
  const double part = (1 - g * g) / (1 - g + 2 * g * u);
  return around(ahead, std::clamp((1 + g * g - part * part) / (2 * g), -1.0, 1.0), turn);
}

}  // namespace limpid::trace

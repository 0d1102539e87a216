#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include <glm/vec3.hpp>

#include "limpid/core/camera.h"
#include "limpid/core/frame.h"
#include "limpid/optics/depth.h"

/// @file
/// The conversion of planes on entry, so that no operator reads a NaN: invalid values are replaced
/// and counted, depth becomes linear eye depth, normals become unit vectors. All functions work in
/// place, with any strides.

namespace limpid {

/// How many values were replaced because they were NaN, and because they were +inf or -inf.
struct Replaced {
  std::int64_t nan = 0, inf = 0;

  std::int64_t total() const { return nan + inf; }
  Replaced& operator+=(const Replaced& more);
  friend bool operator==(const Replaced&, const Replaced&) = default;
};

/// The numbers of replaced values (a depth of +inf means "no surface hit" and is not counted), by
/// role.
struct SanitiseCounts {
  std::array<Replaced, kPlaneCount> by_role{};  ///< at the role's first plane

  /// `first` is the role's first plane.
  Replaced& of(PlaneId first) { return by_role[index_of(first)]; }
  const Replaced& of(PlaneId first) const { return by_role[index_of(first)]; }
  Replaced& of(const Role& role) { return by_role[index_of(role.first)]; }
  const Replaced& of(const Role& role) const { return by_role[index_of(role.first)]; }
  SanitiseCounts& operator+=(const SanitiseCounts& more);
  std::int64_t total() const;
  /// "color 3 NaN 1 inf, depth 2 NaN", or "" if no value was replaced.
  std::string to_text() const;
};

/// The replacement of a color of +inf: the largest half, also if the color is stored as float, so
/// that sums and means of it stay finite. An alpha of +inf becomes 1.
inline constexpr float kLargestColor = 65504;

/// NaN, -inf -> 0, +inf -> `largest`.
Replaced sanitise_color(const View<float>& plane, float largest = kLargestColor);

/// NaN, inf -> 1, then clamped to 0 ... 1; counts NaN and infinities.
Replaced sanitise_shadow(const View<float>& plane);

/// NaN, inf -> 0, then clamped to 0 ... 1; counts NaN and infinities.
Replaced sanitise_mask(const View<float>& plane);

/// Normalises; `up` replaces a normal with a NaN or infinite component, and one of length 0. Counts
/// the normals with a NaN, and those with an infinity and no NaN; does not count normals of length
/// 0, which renderers write where no surface was hit.
Replaced sanitise_normal(const View<float>& x, const View<float>& y, const View<float>& z,
                         glm::dvec3 up);

/// The kind of a depth plane, and the data for its conversion to linear eye depth.
struct DepthSource {
  DepthKind kind = DepthKind::kEye;
  bool half = false;  ///< stored as half: 6e4 and above means "no surface hit", else 1e9 and above
  double near = 0, far = 0;        ///< kNormalised
  const Camera* camera = nullptr;  ///< kRay and kDevice
  Rect display = {};               ///< kRay
  /// The stored value that means "no surface hit", besides the usual ones.
  std::optional<double> nothing = {};
  /// Whether alpha is 0 at a pixel: a stored depth of 0 then means "no surface hit".
  std::function<bool(int x, int y)> uncovered = {};
};

/// Replaces the values of the plane by linear eye depth; values for "no surface hit", NaN and -inf
/// become +inf, and NaN and -inf are counted. Throws Error if the kind needs a camera, or near and
/// far, and `source` lacks it.
Replaced make_eye_depth(const View<float>& plane, const DepthSource& source);

/// The replacement of +inf in planes of a role with colors.
float largest_of(PlaneId plane);

/// Applies the function above that belongs to its role to each plane that is present (`planes` by
/// PlaneId). `source_of` gives the kind of the depth planes; without it they are linear eye depth
/// in float.
SanitiseCounts sanitise_planes(std::span<Plane> planes, glm::dvec3 up,
                               const std::function<DepthSource(const Role&)>& source_of = {});

}  // namespace limpid

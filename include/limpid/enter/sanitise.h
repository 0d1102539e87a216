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
/// What is done to planes once, on entry, so that no operator ever meets a NaN: values that mean
/// nothing are replaced and counted, depth becomes linear eye depth, normals become unit. All in
/// place, any strides.

namespace limpid {

/// How many values were replaced because they were NaN, and because they were +inf or -inf.
struct Replaced {
  std::int64_t nan = 0, inf = 0;

  std::int64_t total() const { return nan + inf; }
  Replaced& operator+=(const Replaced& more);
  friend bool operator==(const Replaced&, const Replaced&) = default;
};

/// What was replaced where it means nothing (a depth of +inf means "nothing hit" and is not
/// counted), by role.
struct SanitiseCounts {
  std::array<Replaced, kPlaneCount> by_role{};  ///< at the role's first plane

  /// `first` is the role's first plane.
  Replaced& of(PlaneId first) { return by_role[index_of(first)]; }
  const Replaced& of(PlaneId first) const { return by_role[index_of(first)]; }
  Replaced& of(const Role& role) { return by_role[index_of(role.first)]; }
  const Replaced& of(const Role& role) const { return by_role[index_of(role.first)]; }
  SanitiseCounts& operator+=(const SanitiseCounts& more);
  std::int64_t total() const;
  /// "color 3 NaN 1 inf, depth 2 NaN", or "" when nothing was replaced.
  std::string to_text() const;
};

/// What a color of +inf becomes: the largest half, also where the color is stored as float, so that
/// sums and means of it stay finite. An alpha of +inf becomes 1.
inline constexpr float kLargestColor = 65504;

/// NaN, -inf -> 0, +inf -> `largest`.
Replaced sanitise_color(const View<float>& plane, float largest = kLargestColor);

/// NaN, inf -> 1, then clamped to 0 ... 1; what was NaN or infinite is counted.
Replaced sanitise_shadow(const View<float>& plane);

/// NaN, inf -> 0, then clamped to 0 ... 1; what was NaN or infinite is counted.
Replaced sanitise_mask(const View<float>& plane);

/// Made unit; where a component is NaN or infinite or all are 0, `up` instead. Counts the normals
/// with a NaN, and those with an infinity and no NaN; not those of 0, which renderers write where
/// there is no surface.
Replaced sanitise_normal(const View<float>& x, const View<float>& y, const View<float>& z,
                         glm::dvec3 up);

/// What a depth plane holds, and what is needed to make linear eye depth of it.
struct DepthSource {
  DepthKind kind = DepthKind::kEye;
  bool half = false;         ///< stored as half: 6e4 and above is "nothing hit", else 1e9 and above
  double near = 0, far = 0;  ///< kNormalised
  const Camera* camera = nullptr;  ///< kRay and kDevice
  Rect display = {};               ///< kRay
  /// As it is stored, "nothing hit" besides what always is: exactly this value.
  std::optional<double> nothing = {};
  /// Whether alpha is 0 at a pixel: a stored depth of 0 is "nothing hit" there.
  std::function<bool(int x, int y)> uncovered = {};
};

/// Linear eye depth in place of whatever the plane holds; "nothing hit", NaN and -inf become +inf,
/// of which NaN and -inf are counted. Throws Error when the kind needs a camera, or near and far,
/// that is not there.
Replaced make_eye_depth(const View<float>& plane, const DepthSource& source);

/// What the plane of a role becomes in place of +inf, where the role's values are colors.
float largest_of(PlaneId plane);

/// All of the above, by role, to the planes that are there (by PlaneId). `source_of` says what the
/// depth planes hold; without it they are linear eye depth in float.
SanitiseCounts sanitise_planes(std::span<Plane> planes, glm::dvec3 up,
                               const std::function<DepthSource(const Role&)>& source_of = {});

}  // namespace limpid

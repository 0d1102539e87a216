#pragma once
#include "limpid/core/camera.h"
#include "limpid/core/number.h"

/// @file
/// Linear eye depth (distance along the view axis, scene units, positive in front) from each of the
/// other ways to store depth. The chain itself sees eye depth only. +inf stays +inf where the kind
/// can say it.

namespace limpid {

/// What a depth plane holds.
enum class DepthKind {
  kEye,  ///< distance along the view axis
  kRay,  ///< distance from the eye along the pixel's ray (from the image plane, if orthographic)
  kInverse,     ///< 1 / eye depth, 0 where nothing was hit (Nuke)
  kNormalised,  ///< 0 at near ... 1 at far, linear; 1 and above reads as nothing hit
  kDevice,      ///< clip z after the division; the far plane reads as nothing hit
};

/// `ray_length` is the length of the pixel's ray per unit of eye depth (that of Rays::ray_at()).
template <class F>
LIMPID_INLINE F eye_depth_from_ray_distance(F distance, F ray_length) {
  return distance / ray_length;
}

/// 0 gives +inf.
template <class F>
LIMPID_INLINE F eye_depth_from_inverse(F inverse) {
  return F(1) / inverse;
}

template <class F>
LIMPID_INLINE F eye_depth_from_normalised(F t, F near, F far) {
  return near + t * (far - near);
}

/// The two middle rows of a projection, which is all that depth depends on: device depth is
/// (z_scale z + z_offset) / (w_scale z + w_offset) for eye-space z (negative in front).
struct DeviceDepth {
  double z_scale, z_offset, w_scale, w_offset;
};

inline DeviceDepth device_depth_of(const Camera& camera) {
  const glm::dmat4& p = camera.projection;
  return {p[2][2], p[3][2], p[2][3], p[3][3]};
}

/// Inverts the projection's rows, whatever they are: GL, D3D, reversed, finite or infinite far,
/// perspective or orthographic. Device depth at an infinite far plane gives +-inf (0 below the
/// line).
template <class F>
LIMPID_INLINE F eye_depth_from_device(F device, const DeviceDepth& rows) {
  return (F(rows.z_offset) - device * F(rows.w_offset)) /
         (F(rows.z_scale) - device * F(rows.w_scale));
}

}  // namespace limpid

#pragma once
#include "limpid/core/camera.h"
#include "limpid/core/number.h"

/// @file
/// Linear eye depth (distance along the view axis, scene units, positive in front) from each kind
/// of stored depth. The chain reads eye depth only. +inf stays +inf if the kind can represent it.

namespace limpid {

/// The kind of depth in a plane.
enum class DepthKind {
  kEye,  ///< distance along the view axis
  kRay,  ///< distance from the eye along the pixel's ray (from the image plane, if orthographic)
  kInverse,     ///< 1 / eye depth, 0 where no surface was hit (Nuke)
  kNormalised,  ///< 0 at near ... 1 at far, linear; 1 and above means no surface hit
  kDevice,      ///< clip z after the division; the far plane means no surface hit
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

/// The part of a projection that device depth depends on, the numbers of its z and w rows: device
/// depth is (z_scale z + z_offset) / (w_scale z + w_offset) for eye-space z (negative in front).
struct DeviceDepth {
  double z_scale, z_offset, w_scale, w_offset;
};

inline DeviceDepth device_depth_of(const Camera& camera) {
  const glm::dmat4& p = camera.projection;
  return {p[2][2], p[3][2], p[2][3], p[3][3]};
}

/// Inverts these rows of any projection: GL, D3D, reversed, finite or infinite far, perspective or
/// orthographic. Device depth at an infinite far plane gives +inf or -inf (a division by 0).
template <class F>
LIMPID_INLINE F eye_depth_from_device(F device, const DeviceDepth& rows) {
  return (F(rows.z_offset) - device * F(rows.w_offset)) /
         (F(rows.z_scale) - device * F(rows.w_scale));
}

}  // namespace limpid

#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limpid {

/// The range of clip z after the division: GL -1 (near) ... 1 (far), D3D and Vulkan 0 ... 1,
/// reversed 1 (near) ... 0 (far).
enum class ClipSpace { kGl, kD3d, kReversed };

/// A camera by its two matrices, for column vectors: `view` = view-from-world (rigid; view space
/// looks down -Z, +Y up), `projection` = clip-from-view, perspective or orthographic, lens shift
/// and non-square pixels included, near finite, far finite or infinite. `clip` is the range of clip
/// z of the projection.
struct Camera {
  glm::dmat4 view{1.0};
  glm::dmat4 projection{1.0};
  ClipSpace clip = ClipSpace::kGl;

  /// Throws Error for a matrix with NaN, a view that is singular or not rigid, or a projection that
  /// is neither perspective nor orthographic.
  void validate() const;
  bool orthographic() const;
  glm::dvec3 eye() const;    ///< world position
  glm::dvec3 right() const;  ///< unit, world
  glm::dvec3 up() const;     ///< unit, world

  /// Clip z after the division, for an eye depth (positive in front).
  double device_from_eye_depth(double eye_depth) const;
  /// Device depth at infinity or at the far plane, whichever the projection has.
  double far_device_depth() const { return clip == ClipSpace::kReversed ? 0.0 : 1.0; }
  /// Eye depth of the near plane and of the far plane, +inf for an infinite projection.
  double near_depth() const;
  double far_depth() const;
};

/// A right-handed perspective projection for the clip space, `fov_y` in radians; `far` may be +inf.
/// `shift` moves the picture by this number of half widths and half heights (lens shift). Throws
/// Error unless 0 < fov_y < pi, aspect > 0, 0 < near < far.
glm::dmat4 perspective(double fov_y, double aspect, double near, double far, ClipSpace clip,
                       glm::dvec2 shift = {0, 0});

/// A right-handed orthographic projection, `width` x `height` scene units. Throws Error unless
/// width and height are above 0 and near < far are finite.
glm::dmat4 orthographic(double width, double height, double near, double far, ClipSpace clip);

/// The eye ray of every pixel. With pixel coordinates x, y (centres at +0.5, display window at
/// 0,0):
///
///     world point - eye = (origin + x origin_dx + y origin_dy) + Z (ray + x ray_dx + y ray_dy)
///
/// for linear eye depth Z. Perspective cameras have origin = 0, orthographic ones ray_dx = ray_dy =
/// 0.
struct Rays {
  glm::dvec3 origin, origin_dx, origin_dy;
  glm::dvec3 ray, ray_dx, ray_dy;

  glm::dvec3 ray_at(double x, double y) const { return ray + x * ray_dx + y * ray_dy; }
  glm::dvec3 origin_at(double x, double y) const { return origin + x * origin_dx + y * origin_dy; }
};

/// `size` is that of the display window.
Rays rays_of(const Camera& camera, glm::ivec2 size);

}  // namespace limpid

#include "limpid/core/camera.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

// GLM indexes [column][row]; the formulas below read better as row, column.
double at(const glm::dmat4& m, int row, int column) { return m[column][row]; }

bool finite(const glm::dmat4& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!std::isfinite(m[c][r])) return false;
    }
  }
  return true;
}

glm::dmat3 world_from_view(const Camera& camera) { return glm::inverse(glm::dmat3(camera.view)); }

struct DepthRow {
  double z, one;
};

/// The z row of a projection whose w row is (0, 0, -1, 0), for near and a far that may be infinite.
DepthRow perspective_depth(double near, double far, ClipSpace clip) {
  const double r = std::isinf(far) ? 0.0 : near / far;  // every entry as a function of near / far
  switch (clip) {
    case ClipSpace::kGl:
      return {-(1 + r) / (1 - r), -2 * near / (1 - r)};
    case ClipSpace::kD3d:
      return {-1 / (1 - r), -near / (1 - r)};
    case ClipSpace::kReversed:
      return {r / (1 - r), near / (1 - r)};
  }
  return {};
}

/// The eye depth with this device depth.
double eye_depth_of(const glm::dmat4& p, double device) {
  return (at(p, 2, 3) - device * at(p, 3, 3)) / (at(p, 2, 2) - device * at(p, 3, 2));
}

}  // namespace

bool Camera::orthographic() const { return at(projection, 3, 2) == 0; }

void Camera::validate() const {
  if (!finite(view)) throw Error("camera: the view matrix has a NaN or infinite entry");
  if (!finite(projection)) throw Error("camera: the projection matrix has a NaN or infinite entry");
  const glm::dmat3 linear(view);
  const double determinant = glm::determinant(linear);
  if (!(std::abs(determinant) > 1e-12)) {
    throw Error("camera: the view matrix is singular (determinant " + std::to_string(determinant) +
                ")");
  }
  const glm::dmat3 product = glm::transpose(linear) * linear;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      if (std::abs(product[c][r] - (c == r)) > 1e-3) {
        throw Error(
            "camera: the view matrix scales or shears, expected a rotation and a translation");
      }
    }
  }
  if (at(view, 3, 0) != 0 || at(view, 3, 1) != 0 || at(view, 3, 2) != 0 || at(view, 3, 3) != 1) {
    throw Error("camera: the last row of the view matrix is not 0 0 0 1");
  }
  const bool affine_w = at(projection, 3, 0) == 0 && at(projection, 3, 1) == 0;
  const bool perspective_w = at(projection, 3, 2) < 0 && at(projection, 3, 3) == 0;
  const bool orthographic_w = at(projection, 3, 2) == 0 && at(projection, 3, 3) > 0;
  if (!affine_w || !(perspective_w || orthographic_w)) {
    throw Error(
        "camera: the last row of the projection is neither 0 0 -1 0 (perspective) nor 0 0 0 1 "
        "(orthographic)");
  }
  const double across =
      at(projection, 0, 0) * at(projection, 1, 1) - at(projection, 0, 1) * at(projection, 1, 0);
  if (!(std::abs(across) > 1e-12)) throw Error("camera: the projection matrix is singular");
}

glm::dvec3 Camera::eye() const { return -(world_from_view(*this) * glm::dvec3(view[3])); }
glm::dvec3 Camera::right() const { return glm::normalize(world_from_view(*this)[0]); }
glm::dvec3 Camera::up() const { return glm::normalize(world_from_view(*this)[1]); }

double Camera::device_from_eye_depth(double eye_depth) const {
  const double z = -eye_depth;
  return (at(projection, 2, 2) * z + at(projection, 2, 3)) /
         (at(projection, 3, 2) * z + at(projection, 3, 3));
}

double Camera::near_depth() const {
  return eye_depth_of(projection, clip == ClipSpace::kGl ? -1 : clip == ClipSpace::kD3d ? 0 : 1);
}

double Camera::far_depth() const {
  const double far = eye_depth_of(projection, far_device_depth());
  return far > near_depth() ? far : HUGE_VAL;  // an infinite far plane, but for rounding
}

glm::dmat4 perspective(double fov_y, double aspect, double near, double far, ClipSpace clip,
                       glm::dvec2 shift) {
  if (!(fov_y > 0 && fov_y < std::numbers::pi)) {
    throw Error("camera: field of view " + std::to_string(fov_y) + " rad, expected 0 ... pi");
  }
  if (!(aspect > 0) || std::isinf(aspect)) {
    throw Error("camera: aspect " + std::to_string(aspect) + ", expected a number above 0");
  }
  if (!(near > 0 && near < far)) {
    throw Error("camera: near " + std::to_string(near) + ", far " + std::to_string(far) +
                ", expected 0 < near < far");
  }
  const double focal = 1 / std::tan(fov_y / 2);
  const DepthRow depth = perspective_depth(near, far, clip);
  glm::dmat4 m(0.0);
  m[0][0] = focal / aspect;
  m[1][1] = focal;
  m[2] = {-shift.x, -shift.y, depth.z, -1};
  m[3][2] = depth.one;
  return m;
}

glm::dmat4 orthographic(double width, double height, double near, double far, ClipSpace clip) {
  if (!(width > 0) || !(height > 0) || std::isinf(width) || std::isinf(height)) {
    throw Error("camera: orthographic extent " + std::to_string(width) + " x " +
                std::to_string(height) + ", expected numbers above 0");
  }
  if (!(near < far) || std::isinf(near) || std::isinf(far)) {
    throw Error("camera: near " + std::to_string(near) + ", far " + std::to_string(far) +
                ", expected near < far, both finite");
  }
  const double at_near = clip == ClipSpace::kGl ? -1 : clip == ClipSpace::kD3d ? 0 : 1;
  const double at_far = clip == ClipSpace::kReversed ? 0 : 1;
  glm::dmat4 m(0.0);
  m[0][0] = 2 / width;
  m[1][1] = 2 / height;
  m[2][2] = -(at_far - at_near) / (far - near);
  m[3] = {0, 0, at_near - near * (at_far - at_near) / (far - near), 1};
  return m;
}

Rays rays_of(const Camera& camera, glm::ivec2 size) {
  const glm::dmat4& p = camera.projection;
  const glm::dmat3 to_world = world_from_view(camera);
  const glm::dmat2 across =
      glm::inverse(glm::dmat2(at(p, 0, 0), at(p, 1, 0), at(p, 0, 1), at(p, 1, 1)));
  // In view space, z = -Z and W = W0 + Z W1; then (x, y) solves
  // across (x, y) = ndc W - (p02, p12) z - (p03, p13), affine in ndc and in Z.
  const double w0 = at(p, 3, 3), w1 = -at(p, 3, 2);
  const glm::dvec2 z_term(at(p, 0, 2), at(p, 1, 2)), constant(at(p, 0, 3), at(p, 1, 3));
  const glm::dvec2 ndc0(-1, 1), ndc_dx(2.0 / size.x, 0), ndc_dy(0, -2.0 / size.y);
  const auto world = [&](glm::dvec2 xy, double z) { return to_world * glm::dvec3(xy, z); };
  Rays rays;
  rays.origin = world(across * (ndc0 * w0 - constant), 0);
  rays.origin_dx = world(across * (ndc_dx * w0), 0);
  rays.origin_dy = world(across * (ndc_dy * w0), 0);
  rays.ray = world(across * (ndc0 * w1 + z_term), -1);
  rays.ray_dx = world(across * (ndc_dx * w1), 0);
  rays.ray_dy = world(across * (ndc_dy * w1), 0);
  return rays;
}

}  // namespace limpid

#include "limpid/enter/sanitise.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "limpid/core/error.h"

#include "enter/nothing_hit.h"
#include "enter/valid_row.h"

namespace limpid {
namespace {

constexpr float kNoHit = std::numeric_limits<float>::infinity();

template <class Fn>
void for_each_pixel(const View<float>& plane, Fn&& fn) {
  const Rect& w = plane.window;
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) fn(plane.at(x, y), x, y);
  }
}

/// Passes all values of rows with any invalid value, which nearly no row has, to `fn`; `fn` leaves
/// valid values unchanged.
template <class Fn>
void for_each_in_invalid_rows(const View<float>& plane, const ValidRange& range, Fn&& fn) {
  const Rect& w = plane.window;
  for (int y = w.y0; y < w.y1; ++y) {
    if (row_is_valid(range, plane.row(y), plane.x_stride, w.width())) continue;
    for_each_pixel({plane.row(y), plane.x_stride, plane.y_stride, {w.x0, y, w.x1, y + 1}}, fn);
  }
}

void count(Replaced& replaced, float value) { ++(std::isnan(value) ? replaced.nan : replaced.inf); }

/// Applies convert(value, x, y) to values that are not "nothing hit"; counts values that were, or
/// were converted to, NaN or -inf.
template <class Missed, class Convert>
Replaced convert_depth(const View<float>& plane, Missed&& missed, Convert&& convert) {
  Replaced replaced;
  for_each_pixel(plane, [&](float& z, int x, int y) {
    const float depth =
        missed(z) ? kNoHit : static_cast<float>(convert(static_cast<double>(z), x, y));
    const bool means_nothing = !(depth > -kNoHit);
    if (means_nothing) count(replaced, std::isfinite(z) ? depth : z);
    z = means_nothing ? kNoHit : depth;
  });
  return replaced;
}

/// Clamps to 0 ... 1; NaN and inf become `otherwise` and are counted.
Replaced sanitise_share(const View<float>& plane, Sanitise kind, float otherwise) {
  Replaced replaced;
  for_each_in_invalid_rows(plane, valid_range(kind), [&](float& s, int, int) {
    if (std::isfinite(s)) {
      s = s < 0 ? 0 : s > 1 ? 1 : s;
    } else {
      count(replaced, s);
      s = otherwise;
    }
  });
  return replaced;
}

const Camera& camera_of(const DepthSource& source, const char* kind) {
  if (source.camera == nullptr) {
    throw Error(std::string("depth of kind ") + kind + " needs a camera, and the scene has none");
  }
  return *source.camera;
}

}  // namespace

Replaced& Replaced::operator+=(const Replaced& more) {
  nan += more.nan;
  inf += more.inf;
  return *this;
}

SanitiseCounts& SanitiseCounts::operator+=(const SanitiseCounts& more) {
  for (std::size_t i = 0; i < by_role.size(); ++i) by_role[i] += more.by_role[i];
  return *this;
}

std::int64_t SanitiseCounts::total() const {
  std::int64_t total = 0;
  for (const Replaced& replaced : by_role) total += replaced.total();
  return total;
}

std::string SanitiseCounts::to_text() const {
  std::vector<std::string> parts;
  for (const Role& role : roles()) {
    const Replaced& replaced = of(role);
    if (replaced.total() == 0) continue;
    std::string text(role.name);
    if (replaced.nan != 0) text += " " + std::to_string(replaced.nan) + " NaN";
    if (replaced.inf != 0) text += " " + std::to_string(replaced.inf) + " inf";
    parts.push_back(text);
  }
  return join(parts);
}

float largest_of(PlaneId plane) { return plane == PlaneId::kColorA ? 1 : kLargestColor; }

Replaced sanitise_color(const View<float>& plane, float largest) {
  Replaced replaced;
  for_each_in_invalid_rows(plane, valid_range(Sanitise::kColor), [&](float& c, int, int) {
    if (std::isfinite(c)) return;
    count(replaced, c);
    c = c > 0 ? largest : 0;
  });
  return replaced;
}

Replaced sanitise_shadow(const View<float>& plane) {
  return sanitise_share(plane, Sanitise::kShadow, 1);
}

Replaced sanitise_mask(const View<float>& plane) {
  return sanitise_share(plane, Sanitise::kMask, 0);
}

Replaced sanitise_normal(const View<float>& x, const View<float>& y, const View<float>& z,
                         glm::dvec3 up) {
  Replaced replaced;
  for_each_pixel(x, [&](float& nx, int column, int row) {
    float& ny = y.at(column, row);
    float& nz = z.at(column, row);
    const glm::dvec3 n(nx, ny, nz);
    const bool finite = std::isfinite(nx) && std::isfinite(ny) && std::isfinite(nz);
    const double length = glm::length(n);
    if (!finite) count(replaced, std::isnan(nx) || std::isnan(ny) ? nx + ny : nz);
    const glm::dvec3 unit = finite && length > 1e-15 ? n / length : up;
    nx = static_cast<float>(unit.x);
    ny = static_cast<float>(unit.y);
    nz = static_cast<float>(unit.z);
  });
  return replaced;
}

Replaced make_eye_depth(const View<float>& plane, const DepthSource& source) {
  mark_nothing_hit(plane, source);
  const float nothing = source.half ? 6e4f : 1e9f;
  const auto far_away = [=](float z) { return z >= nothing; };
  switch (source.kind) {
    case DepthKind::kEye: {
      Replaced replaced;
      for_each_in_invalid_rows(plane, valid_range(Sanitise::kDepth, nothing),
                               [&](float& z, int, int) {
                                 if (z > -kNoHit && z < nothing) return;
                                 if (!(z > -kNoHit)) count(replaced, z);
                                 z = kNoHit;
                               });
      return replaced;
    }
    case DepthKind::kRay: {
      const Rect& d = source.display;
      const Rays rays = rays_of(camera_of(source, "ray"), {d.width(), d.height()});
      return convert_depth(plane, far_away, [&](double z, int x, int y) {
        const double length = glm::length(rays.ray_at(x - d.x0 + 0.5, y - d.y0 + 0.5));
        return eye_depth_from_ray_distance(z, length);
      });
    }
    case DepthKind::kInverse:
      return convert_depth(
          plane, [](float z) { return z <= 0; },
          [](double z, int, int) { return eye_depth_from_inverse(z); });
    case DepthKind::kNormalised:
      if (!(source.far > source.near) || std::isinf(source.far)) {
        throw Error(
            "depth of kind normalised needs near and far, expected near < far, both finite");
      }
      return convert_depth(
          plane, [](float z) { return z >= 1; },
          [&](double z, int, int) {
            return eye_depth_from_normalised(z, source.near, source.far);
          });
    case DepthKind::kDevice: {
      const Camera& camera = camera_of(source, "device");
      const DeviceDepth rows = device_depth_of(camera);
      const bool reversed = camera.clip == ClipSpace::kReversed;
      return convert_depth(
          plane, [=](float z) { return reversed ? z <= 0 : z >= 1; },
          [&](double z, int, int) { return eye_depth_from_device(z, rows); });
    }
  }
  return {};
}

SanitiseCounts sanitise_planes(std::span<Plane> planes, glm::dvec3 up,
                               const std::function<DepthSource(const Role&)>& source_of) {
  SanitiseCounts replaced;
  for (const Role& role : roles()) {
    const auto plane = [&](int i) -> Plane& {
      return planes[static_cast<std::size_t>(index_of(plane_after(role.first, i)))];
    };
    if (!plane(0)) continue;
    Replaced& counted = replaced.of(role);
    switch (role.sanitise) {
      case Sanitise::kColor:
        for (int i = 0; i < role.count; ++i) {
          if (!plane(i)) continue;
          counted += sanitise_color(plane(i).view(), largest_of(plane_after(role.first, i)));
        }
        break;
      case Sanitise::kShadow:
        counted += sanitise_shadow(plane(0).view());
        break;
      case Sanitise::kMask:
        counted += sanitise_mask(plane(0).view());
        break;
      case Sanitise::kNormal:
        counted += sanitise_normal(plane(0).view(), plane(1).view(), plane(2).view(), up);
        break;
      case Sanitise::kDepth:
        counted += make_eye_depth(plane(0).view(), source_of ? source_of(role) : DepthSource{});
        break;
    }
  }
  return replaced;
}

}  // namespace limpid

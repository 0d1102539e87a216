#include "limpid/enter/sanitise.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>

#include "limpid/core/error.h"

#include "enter/nothing_hit.h"
#include "enter/sane_row.h"

namespace limpid {
namespace {

constexpr float kNothingHit = std::numeric_limits<float>::infinity();

template <class Fn>
void for_each_pixel(const View<float>& plane, Fn&& fn) {
  const Rect& w = plane.window;
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) fn(plane.at(x, y), x, y);
  }
}

/// All values of rows that hold any insane one, which nearly always none does. `fn` leaves the sane
/// ones as they are.
template <class Fn>
void for_each_insane(const View<float>& plane, const SaneRange& range, Fn&& fn) {
  const Rect& w = plane.window;
  for (int y = w.y0; y < w.y1; ++y) {
    if (row_is_sane(range, plane.row(y), plane.x_stride, w.width())) continue;
    for_each_pixel({plane.row(y), plane.x_stride, plane.y_stride, {w.x0, y, w.x1, y + 1}}, fn);
  }
}

/// Applies convert(value, x, y) to what is not "nothing hit"; returns how many values, or what they
/// were converted to, were NaN or -inf.
template <class Missed, class Convert>
std::int64_t convert_depth(const View<float>& plane, Missed&& missed, Convert&& convert) {
  std::int64_t replaced = 0;
  for_each_pixel(plane, [&](float& z, int x, int y) {
    const float depth =
        missed(z) ? kNothingHit : static_cast<float>(convert(static_cast<double>(z), x, y));
    const bool means_nothing = !(depth > -kNothingHit);
    replaced += means_nothing;
    z = means_nothing ? kNothingHit : depth;
  });
  return replaced;
}

/// Clamped to 0 ... 1; NaN and inf become `otherwise` and are counted.
std::int64_t sanitise_share(const View<float>& plane, Sanitise kind, float otherwise) {
  std::int64_t replaced = 0;
  for_each_insane(plane, sane_range(kind), [&](float& s, int, int) {
    if (std::isfinite(s)) {
      s = s < 0 ? 0 : s > 1 ? 1 : s;
    } else {
      s = otherwise;
      ++replaced;
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

std::int64_t SanitiseCounts::total() const {
  return std::accumulate(by_role.begin(), by_role.end(), std::int64_t{0});
}

std::string SanitiseCounts::to_text() const {
  std::vector<std::string> parts;
  for (const Role& role : roles()) {
    if (of(role) != 0) {
      parts.push_back(std::string(role.name) + " " + std::to_string(of(role)));
    }
  }
  return join(parts);
}

std::int64_t sanitise_color(const View<float>& plane) {
  std::int64_t replaced = 0;
  for_each_insane(plane, sane_range(Sanitise::kColor), [&](float& c, int, int) {
    if (std::isfinite(c)) return;
    c = 0;
    ++replaced;
  });
  return replaced;
}

std::int64_t sanitise_shadow(const View<float>& plane) {
  return sanitise_share(plane, Sanitise::kShadow, 1);
}

std::int64_t sanitise_mask(const View<float>& plane) {
  return sanitise_share(plane, Sanitise::kMask, 0);
}

std::int64_t sanitise_normal(const View<float>& x, const View<float>& y, const View<float>& z,
                             glm::dvec3 up) {
  std::int64_t replaced = 0;
  for_each_pixel(x, [&](float& nx, int column, int row) {
    float& ny = y.at(column, row);
    float& nz = z.at(column, row);
    const glm::dvec3 n(nx, ny, nz);
    const bool finite = std::isfinite(nx) && std::isfinite(ny) && std::isfinite(nz);
    const double length = glm::length(n);
    replaced += !finite;
    const glm::dvec3 unit = finite && length > 1e-15 ? n / length : up;
    nx = static_cast<float>(unit.x);
    ny = static_cast<float>(unit.y);
    nz = static_cast<float>(unit.z);
  });
  return replaced;
}

std::int64_t make_eye_depth(const View<float>& plane, const DepthSource& source) {
  mark_nothing_hit(plane, source);
  const float nothing = source.half ? 6e4f : 1e9f;
  const auto far_away = [=](float z) { return z >= nothing; };
  switch (source.kind) {
    case DepthKind::kEye: {
      std::int64_t replaced = 0;
      for_each_insane(plane, sane_range(Sanitise::kDepth, nothing), [&](float& z, int, int) {
        if (z > -kNothingHit && z < nothing) return;
        replaced += !(z > -kNothingHit);
        z = kNothingHit;
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
  return 0;
}

SanitiseCounts sanitise_planes(std::span<Plane> planes, glm::dvec3 up,
                               const std::function<DepthSource(const Role&)>& source_of) {
  SanitiseCounts replaced;
  for (const Role& role : roles()) {
    const auto plane = [&](int i) -> Plane& {
      return planes[static_cast<std::size_t>(index_of(plane_after(role.first, i)))];
    };
    if (!plane(0)) continue;
    std::int64_t& count = replaced.of(role);
    switch (role.sanitise) {
      case Sanitise::kColor:
        for (int i = 0; i < role.count; ++i) {
          if (plane(i)) count += sanitise_color(plane(i).view());
        }
        break;
      case Sanitise::kShadow:
        count += sanitise_shadow(plane(0).view());
        break;
      case Sanitise::kMask:
        count += sanitise_mask(plane(0).view());
        break;
      case Sanitise::kNormal:
        count += sanitise_normal(plane(0).view(), plane(1).view(), plane(2).view(), up);
        break;
      case Sanitise::kDepth:
        count += make_eye_depth(plane(0).view(), source_of ? source_of(role) : DepthSource{});
        break;
    }
  }
  return replaced;
}

}  // namespace limpid

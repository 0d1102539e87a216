#include "complete/bottom_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "limpid/ops/look.h"

#include "complete/off_frame_sides.h"
#include "complete/row_heights.h"
#include "op/pixel_start.h"
#include "op/screen_ray.h"
#include "op/seen_planes.h"
#include "optics/refract.h"

namespace limpid {
namespace {

constexpr int kSamples = 1024;       ///< of the bottom, about this number at most
constexpr int kShareSamples = 4096;  ///< of the wet pixels, likewise
constexpr std::size_t kEnough = 16;  ///< samples
constexpr int kTries = 32;

using Sample = BottomSample;

int step_for(const Rect& window, int samples) {
  const double area = static_cast<double>(window.area());
  return std::max(1, static_cast<int>(std::sqrt(area / samples)));
}

/// Points on the picture's rays, relative to the eye.
glm::dvec3 point_at(const Pass& c, double x, double y, double depth) {
  const double column = x + 0.5 - c.corner.x, row = y + 0.5 - c.corner.y;
  return c.rays.origin_at(column, row) + depth * c.rays.ray_at(column, row);
}

Rect looked_up(const Frame& frame, const Pass& pass) {
  const SeenPlanes planes = SeenPlanes::of(pass);
  return intersection(frame.plane(planes.color).window, frame.plane(planes.depth).window);
}

void gather_samples(const Frame& frame, const Pass& c, std::vector<Sample>& samples) {
  const View<const float>& depth = frame.plane(SeenPlanes::of(c).depth);
  const Rect window = looked_up(frame, c);
  const int step = step_for(window, kSamples);
  samples.clear();
  for (int y = window.y0 + step / 2; y < window.y1; y += step) {
    const RowHeights heights(c, y);
    for (int x = window.x0 + step / 2; x < window.x1; x += step) {
      const double z = depth.at(x, y), height = heights.at(x, z);
      if (!(z < 1e30 && height < 0)) continue;
      const glm::dvec3 p = point_at(c, x, y, z);
      const int edge =
          std::min({x - window.x0, window.x1 - 1 - x, y - window.y0, window.y1 - 1 - y});
      const double weight = std::exp(-6.0 * edge / window.height());
      samples.push_back({{glm::dot(c.t, p), glm::dot(c.b, p), glm::dot(c.up, p)}, -height, weight});
    }
  }
}

/// Height = x along t + y along b + z.
using Plane3 = glm::dvec3;

double height_of(const Plane3& plane, const glm::dvec3& at) {
  return plane.x * at.x + plane.y * at.y + plane.z;
}

bool is_bottom(const Plane3& plane) {
  return std::isfinite(plane.x + plane.y + plane.z) &&
         std::hypot(plane.x, plane.y) < BottomPlane::kSteepest;
}

Plane3 plane_through(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dmat3 rows = glm::transpose(
      glm::dmat3(glm::dvec3(a.x, a.y, 1), glm::dvec3(b.x, b.y, 1), glm::dvec3(c.x, c.y, 1)));
  return glm::inverse(rows) * glm::dvec3(a.z, b.z, c.z);
}

double votes(const std::vector<Sample>& samples, const Plane3& plane, double slack) {
  double sum = 0;
  for (const Sample& s : samples) {
    const double off = (s.at.z - height_of(plane, s.at)) / slack;
    sum += s.weight * std::max(0.0, 1 - off * off);
  }
  return sum;
}

/// By least squares, over the samples near a plane.
Plane3 refined(const std::vector<Sample>& samples, const Plane3& plane, double slack) {
  glm::dmat3 products(0.0);
  glm::dvec3 sums(0.0);
  for (const Sample& s : samples) {
    if (!(std::abs(s.at.z - height_of(plane, s.at)) < slack)) continue;
    const glm::dvec3 v(s.at.x, s.at.y, 1);
    products += s.weight * glm::outerProduct(v, v);
    sums += s.weight * s.at.z * v;
  }
  const Plane3 better = glm::inverse(products) * sums;
  return is_bottom(better) ? better : plane;
}

/// The depth that this share of the samples does not reach.
double drop_of(std::vector<Sample>& samples, double share) {
  const auto at =
      samples.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(samples.size()));
  std::nth_element(samples.begin(), at, samples.end(),
                   [](const Sample& a, const Sample& b) { return a.drop < b.drop; });
  return at->drop;
}

Plane3 best_plane(const std::vector<Sample>& samples, double drop, double eye_above, double slack) {
  Plane3 best{0, 0, -eye_above - drop};
  double most = votes(samples, best, slack);
  std::uint32_t state = 1;  // the same planes for the same frame
  const auto any = [&]() -> const glm::dvec3& {
    state = 1664525u * state + 1013904223u;
    return samples[(std::uint64_t{state} * samples.size()) >> 32].at;
  };
  for (int i = 0; i < kTries; ++i) {
    const glm::dvec3 a = any(), b = any(), c = any();
    const Plane3 plane = plane_through(a, b, c);
    if (!is_bottom(plane)) continue;
    const double found = votes(samples, plane, slack);
    if (found <= most) continue;
    most = found;
    best = plane;
  }
  return best;
}

/// Normal of the water: the calm normal where the frame has none.
Vec3<double> normal_at(const Frame& frame, const Pass& c, int x, int y) {
  if (!c.planes.covers(kSurfaceNormalPlanes)) return vec3_of<double>(c.up);
  const auto part = [&](int i) -> double {
    return frame.plane(plane_after(PlaneId::kSurfaceNormalX, i)).at(x, y);
  };
  return {part(0), part(1), part(2)};
}

/// Whether refraction by the water of a pixel moves the lookup of the bottom, and by how many
/// pixels.
std::optional<glm::dvec2> looks_at(const BottomPlane& bottom, const Frame& frame, const Pass& c,
                                   int x, int y) {
  const RowRays<double> rays(c, y - c.corner.y + 0.5);
  const double column = x - c.corner.x + 0.5, calm = rays.calm_depth(column);
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  const double water = surface ? surface.at(x, y) : calm;
  if (!(water < frame.plane(PlaneId::kDepth).at(x, y) && calm < 1e30)) return {};
  Pixel<double> p{};
  begin_pixel(c, rays, column, 1.0, calm, HUGE_VAL, p);
  const Vec3<double> down = refract(p.to_viewer, normal_at(frame, c, x, y), 1 / c.ior).direction;
  const glm::dvec3 direction(down.x, down.y, down.z);
  const glm::dvec3 point(p.surface_point.x, p.surface_point.y, p.surface_point.z);
  const double nears = -glm::dot(bottom.normal, direction);
  const double over = glm::dot(bottom.normal, point) - bottom.offset;
  if (!(nears > 0.02 && over > 0)) return {};
  const Vec2<double> shift = ScreenRay<double>(c, p, down).shift_at(over / nears);
  return glm::dvec2(x + shift.x * c.size.x, y + shift.y * c.size.y);
}

/// A lookup this near to the centre of a texel, in pixels, needs no texel beyond.
constexpr double kRounding = 1e-3;

}  // namespace

double BottomPlane::depth_on(const Pass& c, double x, double y) const {
  const double column = x + 0.5 - c.corner.x, row = y + 0.5 - c.corner.y;
  return (offset - glm::dot(normal, c.rays.origin_at(column, row))) /
         glm::dot(normal, c.rays.ray_at(column, row));
}

std::optional<BottomPlane> fit_bottom(const Frame& frame, const Pass& c,
                                      std::vector<Sample>& samples) {
  if (!(c.eye_above > 0)) return {};
  gather_samples(frame, c, samples);
  if (samples.size() < kEnough) return {};
  const double drop = drop_of(samples, 0.5), shallow = drop_of(samples, 0.05);
  const double slack = 0.1 * drop;
  Plane3 plane = best_plane(samples, drop, c.eye_above, slack);
  for (const double near : {2 * slack, slack}) plane = refined(samples, plane, near);
  const double length = std::sqrt(plane.x * plane.x + plane.y * plane.y + 1);
  const glm::dvec3 normal = (c.up - plane.x * c.t - plane.y * c.b) / length;
  return BottomPlane{normal, plane.z / length, drop, shallow, slack};
}

OffFrameLookups off_frame_sides(const BottomPlane& bottom, const Frame& frame, const Pass& c,
                                int step) {
  const Rect work = frame.work(), there = looked_up(frame, c);
  const Rect& d = frame.display;
  OffFrameLookups off_frame;
  const auto pixels = [](double past, double from_side) {
    return past > kRounding ? static_cast<int>(std::ceil(std::min(from_side - kRounding, 1e6))) : 0;
  };
  const auto look = [&](int x, int y) {
    const auto at = looks_at(bottom, frame, c, x, y);
    if (!at) return;
    off_frame.left = std::max(off_frame.left, pixels(there.x0 - at->x, d.x0 - at->x));
    off_frame.top = std::max(off_frame.top, pixels(there.y0 - at->y, d.y0 - at->y));
    off_frame.right = std::max(off_frame.right, pixels(at->x - there.x1 + 1, at->x - d.x1 + 1));
    off_frame.bottom = std::max(off_frame.bottom, pixels(at->y - there.y1 + 1, at->y - d.y1 + 1));
  };
  for (const int y : {work.y0, work.y1 - 1}) {
    for (int x = work.x0; x < work.x1; x += step) look(x, y);
  }
  for (const int x : {work.x0, work.x1 - 1}) {
    for (int y = work.y0; y < work.y1; y += step) look(x, y);
  }
  return off_frame;
}

OffFrameLookups off_frame_lookups(const BottomPlane& bottom, const Frame& frame, const Pass& c) {
  OffFrameLookups off_frame = off_frame_sides(bottom, frame, c, 1);
  if (!off_frame.any()) return off_frame;
  const Rect work = frame.work(), there = looked_up(frame, c);
  const int step = step_for(work, kShareSamples);
  int wet = 0, off = 0;
  for (int y = work.y0 + step / 2; y < work.y1; y += step) {
    for (int x = work.x0 + step / 2; x < work.x1; x += step) {
      const auto at = looks_at(bottom, frame, c, x, y);
      if (!at) continue;
      ++wet;
      const bool inside = at->x >= there.x0 - kRounding && at->x <= there.x1 - 1 + kRounding &&
                          at->y >= there.y0 - kRounding && at->y <= there.y1 - 1 + kRounding;
      off += inside ? 0 : 1;
    }
  }
  off_frame.share = wet > 0 ? static_cast<double>(off) / wet : 0;
  return off_frame;
}

std::string to_text(const OffFrameLookups& off_frame) {
  if (!off_frame.any()) return "no refracted ray leaves the picture";
  struct Side {
    int pixels;
    const char* place;
  };
  std::vector<std::string> sides;
  for (const Side& side : {Side{off_frame.left, " on the left"},
                           {off_frame.right, " on the right"},
                           {off_frame.top, " at the top"},
                           {off_frame.bottom, " at the bottom"}}) {
    if (side.pixels == 0) continue;
    const char* unit = !sides.empty() ? "" : side.pixels == 1 ? " pixel" : " pixels";
    sides.push_back(std::to_string(side.pixels) + unit + side.place);
  }
  const std::string last = sides.back();
  sides.pop_back();
  char share[16];
  std::snprintf(share, sizeof share, "%.1f %%", 100 * off_frame.share);
  return std::string("the refracted rays of ") + share +
         " of the wet pixels leave the picture; overscan of color and depth by " +
         (sides.empty() ? "" : join(sides) + " and ") + last + " would show where they end";
}

}  // namespace limpid

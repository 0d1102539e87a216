#include "complete/mirror_depth.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/geometric.hpp>

#include "complete/row_heights.h"
#include "complete/rows.h"

namespace limpid {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// Keeps the nearest depth at a pixel, for any order of threads: positive floats and their bits
/// have the same order.
void keep_nearest(float& at, float depth) {
  static_assert(std::numeric_limits<float>::is_iec559);
  const std::uint32_t mine = std::bit_cast<std::uint32_t>(depth);
  std::atomic_ref<std::uint32_t> bits(reinterpret_cast<std::uint32_t&>(at));
  std::uint32_t there = bits.load(std::memory_order_relaxed);
  while (mine < there && !bits.compare_exchange_weak(there, mine, std::memory_order_relaxed)) {
  }
}

/// floor() of a number that an int can hold, without a call.
int whole_of(double x) {
  const int whole = static_cast<int>(x);
  return whole - (whole > x);
}

/// A point's mirror image lies straight below it, and the line to it crosses the screen like a
/// ScreenRay.
void scatter_row(const WaterView& c, const View<const float>& dry, int y, const View<float>& to) {
  const double down_depth = -glm::dot(c.forward, c.up), w_step = c.w_depth * down_depth;
  const double down_u = -glm::dot(c.to_u, c.up), down_v = -glm::dot(c.to_v, c.up);
  const double v = (y - c.corner.y + 0.5) / c.size.y;
  const RowHeights heights(c, y);
  for (int x = dry.window.x0; x < dry.window.x1; ++x) {
    const double depth = dry.at(x, y);
    const double distance = 2 * heights.at(x, depth);
    if (!(distance * c.eye_above > 0 && depth > 0 && depth < 1e30)) continue;
    const double u = (x - c.corner.x + 0.5) / c.size.x;
    const double image_depth = depth + distance * down_depth;
    const double w = c.w_origin + c.w_depth * depth + distance * w_step;
    if (!(w > 0 && image_depth > 0)) continue;
    const double image_u = u + distance * (down_u - u * w_step) / w;
    const double image_v = v + distance * (down_v - v * w_step) / w;
    const double px = image_u * c.size.x + c.corner.x, py = image_v * c.size.y + c.corner.y;
    const Rect& window = to.window;
    if (!(px >= window.x0 && px < window.x1 && py >= window.y0 && py < window.y1)) continue;
    keep_nearest(to.at(whole_of(px), whole_of(py)), static_cast<float>(image_depth));
  }
}

/// A hole with this many neighbours lies between points, or is a pixel beside an edge, which gains
/// the row that points between two pixels have lost.
constexpr int kLeastNeighbours = 3;

/// 0 where nothing was hit.
float finite_of(float depth) { return std::abs(depth) < kNothing ? std::abs(depth) : 0.0f; }
float known_of(float depth) { return std::abs(depth) < kNothing ? 1.0f : 0.0f; }

/// A depth that closes a hole is negative, until tell_real() has confirmed the hole.
void close_holes(const View<const float>& from, int y, const View<float>& to) {
  const Rect& window = from.window;
  const int width = window.width();
  const float* rows[3];
  for (int i = 0; i < 3; ++i) rows[i] = from.row(std::clamp(y + i - 1, window.y0, window.y1 - 1));
  float* out = to.row(y);
  std::copy_n(rows[1], width, out);
  // Without branches, because in most pictures most pixels are such holes; column sums first, which
  // three pixels share.
  constexpr int kColumns = 256;
  float greatest[kColumns + 2], known[kColumns + 2];
  for (int x0 = 1; x0 + 1 < width; x0 += kColumns) {
    const int count = std::min(kColumns, width - 1 - x0);
    const float *above = rows[0] + x0 - 1, *own = rows[1] + x0 - 1, *under = rows[2] + x0 - 1;
    for (int i = 0; i < count + 2; ++i) {
      const float a = finite_of(above[i]), b = finite_of(own[i]), c = finite_of(under[i]);
      const float larger = a < b ? b : a;
      greatest[i] = larger < c ? c : larger;
      known[i] = known_of(above[i]) + known_of(own[i]) + known_of(under[i]);
    }
    for (int i = 0; i < count; ++i) {
      const float depth = own[i + 1];
      const float neighbours = known[i] + known[i + 1] + known[i + 2];
      const float larger = greatest[i] < greatest[i + 1] ? greatest[i + 1] : greatest[i];
      const float fill = larger < greatest[i + 2] ? greatest[i + 2] : larger;
      const float closed = neighbours >= kLeastNeighbours ? -fill : depth;
      out[x0 + i] = depth < kNothing ? depth : closed;
    }
  }
}

/// Assumed thickness of an object at its foot in the water, times its depth: there the mirror saw
/// into the object, whatever it shows through it.
constexpr float kFoot = 0.15f;

/// Within this many pixels over an object's water line, a ray along the water has met the object,
/// whatever the mirror saw through it: far away these pixels are all between the line and the
/// horizon.
constexpr double kLine = 3;

/// Height of a pixel on a surface at an eye depth.
double pixel_height(const WaterView& c, double depth) {
  const auto step = [&](const glm::dvec3& origin, const glm::dvec3& ray) {
    return glm::dot(c.up, origin + depth * ray);
  };
  return std::hypot(step(c.rays.origin_dx, c.rays.ray_dx), step(c.rays.origin_dy, c.rays.ray_dy));
}

void tell_real(const WaterView& c, const View<const float>& dry, const View<const float>& given,
               const View<float>& image, int y, const View<float>& to) {
  const int at_y = std::clamp(y, dry.window.y0, dry.window.y1 - 1);
  const RowHeights heights(c, at_y);
  for (int x = to.window.x0; x < to.window.x1; ++x) {
    const int at_x = std::clamp(x, dry.window.x0, dry.window.x1 - 1);
    const float stands = dry.at(at_x, at_y), seen = image.at(x, y);
    const double height = heights.at(at_x, stands) * ((c.eye_above > 0) - (c.eye_above < 0));
    const auto is_seen_through = [&] {
      const float behind = (1 + kFoot) * stands;
      if (!(std::abs(seen) > behind)) return false;
      const bool told_real = given && given.at(x, y) >= 0.5f;
      return (!told_real && heights.at(at_x, behind) * c.eye_above <= 0) ||
             height < kLine * pixel_height(c, stands);
    };
    const bool inside =
        stands < 1e30f && height > 0 && (!(seen > 0 && seen < kNothing) || is_seen_through());
    image.at(x, y) = inside ? stands : std::abs(seen);
    to.at(x, y) = inside ? 0.0f : given ? given.at(x, y) : 1.0f;
  }
}

}  // namespace

void MirrorDepth::make(const Frame& frame, const WaterView& view, Executor& executor) {
  const View<const float>& dry = frame.plane(PlaneId::kDepth);
  Rect window = frame.plane(PlaneId::kReflectionR).window;
  for (const PlaneId plane : {PlaneId::kReflectionDepth, PlaneId::kReflectionValid}) {
    if (frame.plane(plane)) window = intersection(window, frame.plane(plane).window);
  }
  for (Plane* plane : {&depth_, &valid_}) {
    if (!*plane || plane->view().window != window) *plane = Plane(window);
  }
  const View<float> depth = depth_.view(), valid = valid_.view();
  if (const View<const float>& given = frame.plane(PlaneId::kReflectionDepth)) {
    each_row(executor, window,
             [&](int y) { std::copy_n(&given.at(window.x0, y), window.width(), depth.row(y)); });
  } else {
    each_row(executor, window, [&](int y) { std::fill_n(depth.row(y), window.width(), kNothing); });
    each_row(executor, dry.window, [&](int y) { scatter_row(view, dry, y, depth); });
    // The other plane holds the depths until it is made itself.
    each_row(executor, window, [&](int y) { close_holes(depth, y, valid); });
    each_row(executor, window, [&](int y) { close_holes(valid, y, depth); });
  }
  const View<const float>& given = frame.plane(PlaneId::kReflectionValid);
  each_row(executor, window, [&](int y) { tell_real(view, dry, given, depth, y, valid); });
}

}  // namespace limpid

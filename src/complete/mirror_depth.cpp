#include "complete/mirror_depth.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/geometric.hpp>

#include "complete/mirror_image.h"
#include "complete/mirror_outlines.h"
#include "complete/mirror_sides.h"
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

void scatter_row(const WaterView& c, const View<const float>& dry, int y, const View<float>& to) {
  const MirrorImage images(c, y);
  for (int x = dry.window.x0; x < dry.window.x1; ++x) {
    const double depth = dry.at(x, y);
    if (!(depth > 0 && depth < 1e30 && images.is_above(x, depth))) continue;
    const auto image = images.at(x, depth);
    const Rect& window = to.window;
    if (!(image && image->x >= window.x0 && image->x < window.x1 && image->y >= window.y0 &&
          image->y < window.y1)) {
      continue;
    }
    keep_nearest(to.at(whole_of(image->x), whole_of(image->y)), static_cast<float>(image->depth));
  }
}

/// A hole with this many neighbours lies between points, or is a pixel beside an edge, which gains
/// the row that points between two pixels have lost.
constexpr int kLeastNeighbours = 3;

/// 0 where nothing was hit.
float finite_of(float depth) { return std::abs(depth) < kNothing ? std::abs(depth) : 0.0f; }
float known_of(float depth) { return std::abs(depth) < kNothing ? 1.0f : 0.0f; }

/// Closes the holes of the middle one of three rows. A depth that closes a hole is negative, until
/// tell_real() has confirmed the hole.
void close_row(const std::array<const float*, 3>& rows, int width, float* out) {
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

/// A texel within this height of the water, in pixels, shows in part what the mirror saw under the
/// object.
constexpr double kMixed = 1;

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
    const bool inside = stands < 1e30f && height > 0 &&
                        (height < kMixed * pixel_height(c, stands) ||
                         !(seen > 0 && seen < kNothing) || is_seen_through());
    image.at(x, y) = inside ? stands : std::abs(seen);
    to.at(x, y) = inside ? 0.0f : given ? given.at(x, y) : 1.0f;
  }
}

}  // namespace

/// Closes holes twice, from the points in `valid_` into `depth_`, and calls then(y) after row y, by
/// which time nothing reads that row of `valid_` any more.
template <class Then>
void MirrorDepth::close_holes(Executor& executor, const Then& then) {
  const View<const float> points = valid_.view();
  const Rect& window = points.window;
  const int width = window.width(), count = (window.height() + kBand - 1) / kBand;
  const auto begin_of = [&](int band) { return window.y0 + band * kBand; };
  const auto end_of = [&](int band) { return std::min(begin_of(band + 1), window.y1); };
  const auto close_once = [&](int y, std::vector<float>& to) {
    std::array<const float*, 3> rows;
    for (int i = 0; i < 3; ++i) {
      rows[static_cast<std::size_t>(i)] =
          points.row(std::clamp(y + i - 1, window.y0, window.y1 - 1));
    }
    to.resize(static_cast<std::size_t>(width));
    close_row(rows, width, to.data());
  };
  bands_.resize(static_cast<std::size_t>(count));
  const auto band_of = [&](int band) -> Band& { return bands_[static_cast<std::size_t>(band)]; };
  run_each(executor, count, [&](int band) {
    close_once(begin_of(band), band_of(band).first);
    close_once(end_of(band) - 1, band_of(band).last);
  });
  run_each(executor, count, [&](int band) {
    Band& own = band_of(band);
    const int begin = begin_of(band), end = end_of(band);
    const auto recent = [&](int y) -> std::vector<float>& {
      return own.recent[static_cast<std::size_t>((y - begin) % 3)];
    };
    const auto closed = [&](int y) {
      if (y < begin) return (band > 0 ? band_of(band - 1).last : own.first).data();
      if (y >= end) return (band + 1 < count ? band_of(band + 1).first : own.last).data();
      if (y == begin) return own.first.data();
      return (y == end - 1 ? own.last : recent(y)).data();
    };
    for (int y = begin; y < end; ++y) {
      if (y + 1 < end - 1) close_once(y + 1, recent(y + 1));
      close_row({closed(y - 1), closed(y), closed(y + 1)}, width, depth_.view().row(y));
      then(y);
    }
  });
}

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
  const View<const float>& given = frame.plane(PlaneId::kReflectionValid);
  const auto finish = [&](int y) { tell_real(view, dry, given, depth, y, valid); };
  if (const View<const float>& rendered = frame.plane(PlaneId::kReflectionDepth)) {
    each_row(executor, window, [&](int y) {
      std::copy_n(&rendered.at(window.x0, y), window.width(), depth.row(y));
      finish(y);
    });
    return;
  }
  each_row(executor, window, [&](int y) { std::fill_n(valid.row(y), window.width(), kNothing); });
  each_row(executor, dry.window, [&](int y) { scatter_row(view, dry, y, valid); });
  close_holes(executor, [&](int y) {
    go_on_to_sides(frame, view, depth, y);
    finish(y);
  });
  grow_to_outlines(frame, valid, depth, executor);
}

}  // namespace limpid

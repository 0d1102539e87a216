#include "limpid/complete/heights.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "plan/survey_scan.h"

namespace limpid {
namespace {

/// Blocks that cover a window, from its corner on.
Size blocks_of(const Rect& window) {
  return {(window.width() + HeightBound::kWidth - 1) / HeightBound::kWidth,
          (window.height() + HeightBound::kHeight - 1) / HeightBound::kHeight};
}

std::size_t count_of(Size blocks) { return static_cast<std::size_t>(blocks.width) * blocks.height; }

Size half_of(Size blocks) { return {(blocks.width + 1) / 2, (blocks.height + 1) / 2}; }

bool is_one(Size blocks) { return blocks.width == 1 && blocks.height == 1; }

/// Of a march, in which products may cancel: a few roundings of each.
HeightError march_error(const Context& c) {
  const auto most = [&](const glm::dvec3& at, const glm::dvec3& dx, const glm::dvec3& dy) {
    const glm::dvec3 size =
        glm::abs(at) + 4.0 * c.size.x * glm::abs(dx) + 4.0 * c.size.y * glm::abs(dy);
    return 4e-6 * glm::dot(glm::abs(c.up), size);
  };
  const Rays& r = c.rays;
  return {
      static_cast<float>(4e-6 * std::abs(c.eye_above) + most(r.origin, r.origin_dx, r.origin_dy)),
      static_cast<float>(most(r.ray, r.ray_dx, r.ray_dy))};
}

/// Whether all water that reaches up to `most` is seen from above: what stands higher is nearer.
bool seen_from_above(const Context& context, float most) {
  const bool parallel = context.w_depth == 0;
  return parallel ? glm::dot(context.up, context.rays.ray) < 0 : context.eye_above > most;
}

}  // namespace

struct Heights::Scan {
  const Context& context;
  const ScanTarget& target;
  HeightError error;
  const View<const float>& depth;
  bool water;  ///< the plane is that of the surface
  float most;
  float* heights;

  void chunk(const Rect& pixels, float* to) const {
    const Blocks blocks{pixels.x0, HeightBound::kWidth};
    if (water) return target.highest_water(context, depth, pixels, blocks, to);
    target.highest_seen(context, error, depth, most, pixels, blocks, to);
  }

  /// A task: a row of blocks.
  static void row(void* self, int index) {
    const Scan& s = *static_cast<Scan*>(self);
    const Rect& window = s.depth.window;
    const int across = blocks_of(window).width;
    const int y = window.y0 + index * HeightBound::kHeight;
    for (int first = 0; first < across; first += Blocks::kMost) {
      const int x = window.x0 + first * HeightBound::kWidth;
      const Rect whole{x, y, x + Blocks::kMost * HeightBound::kWidth, y + HeightBound::kHeight};
      s.chunk(intersection(whole, window), s.heights + count_of({across, index}) + first);
    }
  }
};

void Heights::make(const Plan& plan, const Frame& frame, const Context& context, Executor& executor,
                   const std::string& simd) {
  bound_ = {};
  if (!plan.made.has(StatePart::kPosition) || !plan.look.of<Refraction>().marches()) return;
  if (context.submersible) return;
  const PlaneId seen = Refraction::planes_of(context).depth;
  const Rect& window = frame.plane(seen).window;
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  const HeightError error = march_error(context);
  const auto scan = [&](PlaneId plane, bool water) {
    const View<const float>& depth = frame.plane(plane);
    const Size blocks = blocks_of(depth.window);
    std::size_t room = 1;
    for (Size size = blocks; !is_one(size); size = half_of(size)) room += count_of(size);
    heights_.resize(room);
    Scan job{context, scan_target(simd), error, depth, water, bound_.most, heights_.data()};
    executor.run(blocks.height, Scan::row, &job);
    return blocks;
  };
  if (surface) {
    const Size blocks = scan(PlaneId::kSurfaceDepth, true);
    bound_.most = *std::max_element(heights_.data(), heights_.data() + count_of(blocks));
  }
  // Where no water is drawn the calm level stands for it.
  bound_.most = std::max(bound_.most, 0.0f) + error.over;
  if (!seen_from_above(context, bound_.most)) return;
  stack_levels(scan(seen, false));
  bound_.x0 = window.x0;
  bound_.y0 = window.y0;
  bound_.known = true;
}

/// The others on the first one, which is there.
void Heights::stack_levels(Size size) {
  float* to = heights_.data();
  bound_.levels[0] = {to, size.width};
  for (int level = 1; !is_one(size); ++level) {
    const float* from = to;
    const Size before = size;
    to += count_of(size);
    size = half_of(size);
    for (int y = 0; y < size.height; ++y) {
      const float* upper = from + count_of({before.width, 2 * y});
      const float* lower = from + count_of({before.width, std::min(2 * y + 1, before.height - 1)});
      for (int x = 0; x < size.width; ++x) {
        const int left = 2 * x, right = std::min(left + 1, before.width - 1);
        to[count_of({size.width, y}) + x] =
            std::max({upper[left], upper[right], lower[left], lower[right]});
      }
    }
    bound_.levels[level] = {to, size.width};
  }
}

}  // namespace limpid

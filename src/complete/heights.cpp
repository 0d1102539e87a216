#include "complete/heights.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "ops/fresnel_reflection_kernel.h"
#include "ops/refraction_kernel.h"
#include "ops/water_shadow_kernel.h"
#include "plan/survey_scan.h"

namespace limpid {
namespace {

using Blocked = BlockPyramid<SeenHeights>;  // all pyramids have this size

/// Blocks that cover a window, from its corner on.
Size blocks_of(const Rect& window) {
  return {(window.width() + Blocked::kWidth - 1) / Blocked::kWidth,
          (window.height() + Blocked::kHeight - 1) / Blocked::kHeight};
}

std::size_t count_of(Size blocks) { return static_cast<std::size_t>(blocks.width) * blocks.height; }

Size half_of(Size blocks) { return {(blocks.width + 1) / 2, (blocks.height + 1) / 2}; }

bool is_one(Size blocks) { return blocks.width == 1 && blocks.height == 1; }

/// Fills the blocks of a window by look(pixels, blocks, to) on parts of a row of blocks. `cells`
/// gets room for all levels.
template <class Cell, class Look>
void look_at(const Rect& window, Executor& executor, std::vector<Cell>& cells, Look&& look) {
  const Size all = blocks_of(window);
  std::size_t room = 1;
  for (Size size = all; !is_one(size); size = half_of(size)) room += count_of(size);
  cells.resize(room);
  const auto look_at_row = [&](int index) {
    const int y = window.y0 + index * Blocked::kHeight;
    for (int first = 0; first < all.width; first += Blocks::kMost) {
      const int x = window.x0 + first * Blocked::kWidth;
      const Rect some{x, y, x + Blocks::kMost * Blocked::kWidth, y + Blocked::kHeight};
      look(intersection(some, window), Blocks{x, Blocked::kWidth},
           cells.data() + count_of({all.width, index}) + first);
    }
  };
  run_each(executor, all.height, look_at_row);
}

/// Builds the other levels from the first one.
template <class Cell>
void stack_levels(const Rect& window, std::vector<Cell>& cells, BlockPyramid<Cell>& pyramid) {
  Size size = blocks_of(window);
  Cell* to = cells.data();
  pyramid.levels[0] = {to, size.width};
  for (int level = 1; !is_one(size); ++level) {
    const Cell* from = to;
    const Size before = size;
    to += count_of(size);
    size = half_of(size);
    for (int y = 0; y < size.height; ++y) {
      const Cell* upper = from + count_of({before.width, 2 * y});
      const Cell* lower = from + count_of({before.width, std::min(2 * y + 1, before.height - 1)});
      for (int x = 0; x < size.width; ++x) {
        const int left = 2 * x, right = std::min(left + 1, before.width - 1);
        to[count_of({size.width, y}) + x] = Cell::join(Cell::join(upper[left], upper[right]),
                                                       Cell::join(lower[left], lower[right]));
      }
    }
    pyramid.levels[level] = {to, size.width};
  }
  pyramid.x0 = window.x0;
  pyramid.y0 = window.y0;
  pyramid.known = true;
}

/// The error of a march, whose products may cancel: a few roundings of each.
HeightError march_error(const Pass& c) {
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

/// 0 if lookups are not those for which SeenHeights::covers holds.
double path_fraction(const Plan& plan, const Frame& frame, const Pass& pass) {
  const Refraction::Params& params = plan.look.of<Refraction>();
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  const bool kept_in_frame = params.off_frame == Refraction::OffFrame::kShorten ||
                             params.off_frame == Refraction::OffFrame::kContinue;
  const PlaneId seen = SeenPlanes::of(pass).depth;
  const bool same_window = !surface || surface.window == frame.plane(seen).window;
  const bool known =
      params.rejection == Refraction::Rejection::kShorten && kept_in_frame && same_window;
  return known ? Kernel<Refraction>::kShareOfPath : 0;
}

/// Whether all water up to `most` is seen from above: then surfaces higher than that are nearer.
bool seen_from_above(const Pass& pass, float most) {
  const bool parallel = pass.w_depth == 0;
  return parallel ? glm::dot(pass.up, pass.rays.ray) < 0 : pass.eye_above > most;
}

}  // namespace

void Heights::make(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                   const std::string& simd) {
  bound_ = {};
  mirrored_ = lit_ = {};
  const ScanTarget& target = scan_target(simd);
  if (plan.made.has(StatePart::kPosition) && plan.look.of<Refraction>().marches() &&
      !pass.submersible) {
    look_below(plan, frame, pass, executor, target);
  }
  look_at_mirrored(plan, frame, pass, executor, target);
  const View<const float>& shadow = frame.plane(PlaneId::kSurfaceShadow);
  if (!shadow || !Kernel<WaterShadow>::probes(plan.look.of<WaterShadow>(), plan.made)) return;
  look_at(shadow.window, executor, shadows_, [&](const Rect& pixels, Blocks blocks, auto* to) {
    target.range(shadow, pixels, blocks, to);
  });
  stack_levels(shadow.window, shadows_, lit_);
  lit_.plane = PlaneId::kSurfaceShadow;
}

void Heights::look_at_mirrored(const Plan& plan, const Frame& frame, const Pass& pass,
                               Executor& executor, const ScanTarget& target) {
  const std::optional<PlaneId> plane =
      Kernel<FresnelReflection>::marched(plan.look.of<FresnelReflection>(), pass);
  if (!plan.made.has(StatePart::kReflected) || !plane) return;
  const View<const float>& depth = frame.plane(*plane);
  const HeightError error = march_error(pass);
  const bool above = *plane == PlaneId::kDepth && !pass.submersible;
  look_at(depth.window, executor, depths_, [&](const Rect& pixels, Blocks blocks, auto* to) {
    target.seen_depths(pass, error, depth, above, pixels, blocks, to);
  });
  stack_levels(depth.window, depths_, mirrored_);
  mirrored_.plane = *plane;
}

void Heights::look_below(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                         const ScanTarget& target) {
  const SeenPlanes planes = SeenPlanes::of(pass);
  const View<const float>& depth = frame.plane(planes.depth);
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  const HeightError error = march_error(pass);
  if (surface) {
    look_at(surface.window, executor, water_, [&](const Rect& pixels, Blocks blocks, float* to) {
      target.highest_water(pass, surface, pixels, blocks, to);
    });
    const std::size_t count = count_of(blocks_of(surface.window));
    bound_.most = *std::max_element(water_.data(), water_.data() + count);
  }
  // Where no water is drawn the calm level replaces it.
  bound_.most = std::max(bound_.most, 0.0f) + error.over;
  if (!seen_from_above(pass, bound_.most)) return;
  const SeenFrom from{error, bound_.most, path_fraction(plan, frame, pass), planes.below};
  look_at(depth.window, executor, heights_, [&](const Rect& pixels, Blocks blocks, auto* to) {
    target.seen_heights(pass, from, depth, surface, pixels, blocks, to);
  });
  stack_levels(depth.window, heights_, bound_);
}

}  // namespace limpid

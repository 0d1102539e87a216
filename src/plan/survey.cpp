#include "limpid/plan/survey.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "op/seen_planes.h"
#include "plan/cell_rules.h"
#include "plan/operator_table.h"
#include "plan/survey_scan.h"

namespace limpid {

namespace {

/// Extremes of a cell, for the cells whose lookups reach it; least values with their sign turned.
enum Extreme {
  kNear,  ///< depth that lookups may read
  kFar,
  kGap,   ///< 1 if a texel may lie above water
  kDrop,  ///< depth of the bottom under the calm surface
  kShadowLow,
  kShadowHigh,
  kColorLow,
  kColorHigh = kColorLow + 3,
  kExtremeCount = kColorHigh + 3,
};

constexpr int kBlocksInCell = 4, kBlockWidth = Survey::kCell.width / kBlocksInCell;

/// Number of parts of a size that cover so many pixels.
int count_of(int pixels, int part) { return (pixels + part - 1) / part; }

/// How far the plan's refracted lookups reach, in uv.
double reach_of(const Plan& plan, const Pass& pass) {
  double reach = 0, stretch = 1;
  for (int i = 0; i < Chain::kCount; ++i) {
    const OperatorEntry& entry = operator_table()[static_cast<std::size_t>(i)];
    if (!plan.keeps(i) || entry.looks_above) continue;
    reach += entry.reach(plan.look);
    stretch *= entry.stretch(plan.look, pass);
  }
  return reach * stretch;
}

/// Calls visit(i) for the blocks that `pixels` meet.
template <class Visit>
void for_each_block(const Rect& pixels, Blocks blocks, Visit&& visit) {
  const int end = (pixels.x1 - 1 - blocks.x0) / blocks.width;
  for (int i = (pixels.x0 - blocks.x0) / blocks.width; i <= end; ++i) visit(i);
}

template <class E>
void raise(E& to, const E& by) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = to[i] < by[i] ? by[i] : to[i];
}

Rect united(const Rect& a, const Rect& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

}  // namespace

struct __attribute__((visibility("hidden"))) Survey::Scan {
  static_assert(std::tuple_size_v<Extremes> == kExtremeCount);

  Survey& survey;
  const Plan& plan;
  const Frame& frame;
  const Pass& pass;
  const ScanTarget& target;
  SeenPlanes looked_up;
  CellRules rules;
  HeightError error;
  PlaneSet wanted;                             // the planes that lookups read
  PlaneId own_shadow;                          // on the surface
  int reach_x, reach_y;                        // in blocks
  bool everywhere;                             // all blocks are in reach of all cells
  bool same_windows;                           // taps at depth and surface find the same pixel
  Extremes all;                                // of all blocks, if so
  Range shadow_of_water{HUGE_VAL, -HUGE_VAL};  // of the surface, of all cells

  Scan(Survey& s, const Plan& p, const Frame& f, const Pass& c, const ScanTarget& t)
      : survey(s),
        plan(p),
        frame(f),
        pass(c),
        target(t),
        looked_up(SeenPlanes::of(c)),
        rules(p, c),
        error(calm_error(c)) {}

  static void none(Extremes& extremes) { extremes.fill(-HUGE_VALF); }

  /// Blocks first ... end - 1 of a row of blocks.
  struct Chunk {
    int row, first, end;
  };
  Rect pixels_of(const Chunk& c) const {
    const int x = survey.work_.x0 - survey.left_ * kBlockWidth;
    const int y = survey.work_.y0 + (c.row - survey.up_) * kCell.height;
    return {x + c.first * kBlockWidth, y, x + c.end * kBlockWidth, y + kCell.height};
  }
  Extremes& extremes_of(int column, int row) const {
    return survey.extremes_[static_cast<std::size_t>(row) * survey.blocks_.width + column];
  }
  /// The cell of this block.
  Own& own_of(int column, int row) const {
    return survey.own_[static_cast<std::size_t>(row - survey.up_) * survey.cells_.width +
                       (column - survey.left_) / kBlocksInCell];
  }
  glm::dvec3 ray_at(int x, int y) const {
    return pass.rays.ray_at(x - pass.corner.x, y - pass.corner.y);
  }

  bool sees_own_shadow() const {
    return frame.plane(own_shadow) && (plan.planes | plan.completed).has(own_shadow);
  }

  void choose_planes();
  void lay_out();
  void scan_chunk(const Chunk& chunk);
  void scan_water(const Chunk& chunk);
  template <class Into>
  void scan_plane(PlaneId plane, const Rect& within, const Chunk& chunk, Into&& into);
  Range sink_of(const Rect& pixels) const;
  void decide_cell(int index, const Extremes& reached);

  // Tasks, one per row of blocks or cells.
  static void scan_row(void* self, int row);
  static void reach_across(void* self, int row);
  static void decide_row(void* self, int row);
};

/// Only planes that a rule reads. Colors bound the error of a lookup, so they are read only if the
/// plan allows an error.
void Survey::Scan::choose_planes() {
  own_shadow =
      pass.planes.has(PlaneId::kSurfaceShadow) ? PlaneId::kSurfaceShadow : PlaneId::kShadow;
  wanted = plan.planes & PlaneSet{PlaneId::kShadow};
  if (plan.made.has(StatePart::kPosition)) wanted = wanted | PlaneSet{looked_up.depth};
  if (plan.max_error > 0) {
    for (int c = 0; c < 3; ++c) wanted = wanted | PlaneSet{plane_after(looked_up.color, c)};
  }
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  const Rect looked = frame.plane(looked_up.depth).window;
  same_windows =
      looked == frame.plane(PlaneId::kDepth).window && (!surface || looked == surface.window);
}

void Survey::Scan::lay_out() {
  choose_planes();
  const bool refracts = plan.made.has(StatePart::kPosition);
  const Rect work = frame.work();
  Rect area = work;
  for (int i = 0; i < kPlaneCount && refracts; ++i) {
    const bool looked_at = wanted.has(static_cast<PlaneId>(i)) || i == index_of(PlaneId::kDepth);
    if (looked_at && frame.planes[i]) area = united(area, frame.planes[i].window);
  }
  // Two texels more, for filtering and rounding.
  const double uv = refracts ? reach_of(plan, pass) : 0;
  const auto texels = [&](double size) {
    return refracts ? static_cast<int>(std::min(uv * size + 2, double{1 << 24})) : 0;
  };
  const int far_x = texels(pass.size.x), far_y = texels(pass.size.y);
  area = intersection(area, {work.x0 - far_x, work.y0 - far_y, work.x1 + far_x, work.y1 + far_y});

  Survey& s = survey;
  s.work_ = work;
  s.cells_ = {count_of(work.width(), kCell.width), count_of(work.height(), kCell.height)};
  s.left_ = count_of(work.x0 - area.x0, kBlockWidth);
  s.up_ = count_of(work.y0 - area.y0, kCell.height);
  s.blocks_ = {
      s.left_ + std::max(kBlocksInCell * s.cells_.width, count_of(area.x1 - work.x0, kBlockWidth)),
      s.up_ + std::max(s.cells_.height, count_of(area.y1 - work.y0, kCell.height))};
  reach_x = std::min(count_of(far_x, kBlockWidth), s.blocks_.width);
  reach_y = std::min(count_of(far_y, kCell.height), s.blocks_.height);
  everywhere = reach_x == s.blocks_.width && reach_y == s.blocks_.height;
  const auto cells = static_cast<std::size_t>(s.count());
  const auto rows = static_cast<std::size_t>(s.blocks_.height);
  s.own_.assign(cells, Own{});
  s.by_bound_.assign(static_cast<std::size_t>(s.cells_.height), {});
  s.needs_.assign(cells, CellNeeds{});
  s.extremes_.resize(rows * static_cast<std::size_t>(s.blocks_.width));
  s.across_.resize(rows * static_cast<std::size_t>(s.cells_.width));
}

// --- what the planes hold ------------------------------------------------------------------------

void Survey::Scan::scan_row(void* self, int row) {
  Scan& s = *static_cast<Scan*>(self);
  const int width = s.survey.blocks_.width;
  for (int first = 0; first < width; first += Blocks::kMost) {
    s.scan_chunk({row, first, std::min(first + Blocks::kMost, width)});
  }
}

void Survey::Scan::scan_chunk(const Chunk& chunk) {
  for (int i = chunk.first; i < chunk.end; ++i) none(extremes_of(i, chunk.row));
  scan_water(chunk);
  if (sees_own_shadow()) {
    scan_plane(own_shadow, survey.work_, chunk, [&](int column, SeenRange lit) {
      Own& own = own_of(column, chunk.row);
      own.shadow_low = std::min(own.shadow_low, lit.low);
      own.shadow_high = std::max(own.shadow_high, lit.high);
    });
  }
  const auto keep = [&](PlaneId plane, const Rect& within, int low, int high) {
    scan_plane(plane, within, chunk, [&](int column, SeenRange seen) {
      Extremes& extremes = extremes_of(column, chunk.row);
      extremes[low] = std::max(extremes[low], -seen.low);
      extremes[high] = std::max(extremes[high], seen.high);
    });
  };
  const auto window = [&](PlaneId plane) { return frame.plane(plane).window; };
  if (wanted.has(looked_up.depth)) {
    keep(looked_up.depth, window(looked_up.depth), kNear, kFar);
  }
  if (wanted.has(PlaneId::kShadow)) {
    keep(PlaneId::kShadow, window(PlaneId::kShadow), kShadowLow, kShadowHigh);
  }
  for (int c = 0; c < 3 && plan.max_error > 0; ++c) {
    const PlaneId plane = plane_after(looked_up.color, c);
    keep(plane, window(plane), kColorLow + c, kColorHigh + c);
    // Where the layer below is empty, the dry color stays; behind objects in the water is a mean of
    // dry colors.
    const PlaneId dry = plane_after(PlaneId::kColorR, c);
    if (looked_up.below) keep(dry, window(dry), kColorLow + c, kColorHigh + c);
  }
}

/// Calls into(column, range) for each block of the chunk that has texels of the plane within a
/// rectangle. Taps are clamped to the plane's window, so its edge counts as in reach beyond it.
template <class Into>
void Survey::Scan::scan_plane(PlaneId plane, const Rect& within, const Chunk& chunk, Into&& into) {
  const Rect there = intersection(pixels_of(chunk), within);
  if (there.empty()) return;
  std::array<SeenRange, Blocks::kMost> seen;
  const Blocks blocks{pixels_of(chunk).x0, kBlockWidth};
  target.range(frame.plane(plane), there, blocks, seen.data());
  for_each_block(there, blocks, [&](int i) { into(chunk.first + i, seen[i]); });
}

void Survey::Scan::scan_water(const Chunk& chunk) {
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  Rect there = intersection(pixels_of(chunk), depth.window);
  if (surface) there = intersection(there, surface.window);
  if (there.empty()) return;
  const Blocks blocks{pixels_of(chunk).x0, kBlockWidth};
  std::array<WetSeen, Blocks::kMost> seen;
  const bool farthest = plan.max_error > 0;
  target.wet(pass, error, depth, surface, there, blocks, farthest, seen.data());
  std::array<WetSeen, Blocks::kMost> under = seen;
  if (looked_up.below && same_windows) {
    const View<const float>& below = frame.plane(looked_up.depth);
    target.wet(pass, error, below, surface, there, blocks, false, under.data());
  }
  for_each_block(there, blocks, [&](int i) {
    const int column = chunk.first + i;
    const Rect block = intersection(pixels_of({chunk.row, column, column + 1}), there);
    const Rect inside = intersection(block, survey.work_);
    Extremes& extremes = extremes_of(column, chunk.row);
    extremes[kGap] = !same_windows || under[i].sure < block.area() ? 1 : 0;
    if (everywhere && seen[i].wet > 0) {
      const double sink = std::max(sink_of(block).min, 0.0);
      extremes[kDrop] = static_cast<float>(-bound_product(seen[i].own_near, sink));
    }
    if (inside.empty()) return;
    WetSeen water = seen[i];
    if (!(inside == block)) {
      target.wet(pass, error, depth, surface, inside, {inside.x0, kBlockWidth}, farthest, &water);
    }
    if (water.wet == 0) return;
    Own& own = own_of(column, chunk.row);
    own.wet += water.wet;
    own.surface_near = std::min(own.surface_near, water.surface_near);
    own.surface_far = std::max(own.surface_far, water.surface_far);
    own.near = std::min(own.near, water.own_near);
    own.far = std::max(own.far, water.own_far);
  });
}

/// Depth under the surface gained per unit of eye depth, which is linear over the picture.
Range Survey::Scan::sink_of(const Rect& pixels) const {
  Range sink{HUGE_VAL, -HUGE_VAL};
  for (const int x : {pixels.x0, pixels.x1}) {
    for (const int y : {pixels.y0, pixels.y1}) {
      const double here = -glm::dot(pass.up, ray_at(x, y));
      sink = {std::min(sink.min, here), std::max(sink.max, here)};
    }
  }
  return sink;
}

// --- what that means for a cell ------------------------------------------------------------------

void Survey::Scan::reach_across(void* self, int row) {
  const Scan& s = *static_cast<Scan*>(self);
  const Size cells = s.survey.cells_, blocks = s.survey.blocks_;
  const Extremes* from = s.survey.extremes_.data() + static_cast<std::size_t>(row) * blocks.width;
  Extremes* to = s.survey.across_.data() + static_cast<std::size_t>(row) * cells.width;
  for (int cell = 0; cell < cells.width; ++cell) {
    const int first = s.survey.left_ + cell * kBlocksInCell;
    const int end = std::min(first + kBlocksInCell + s.reach_x, blocks.width);
    none(to[cell]);
    for (int i = std::max(first - s.reach_x, 0); i < end; ++i) raise(to[cell], from[i]);
  }
}

void Survey::Scan::decide_row(void* self, int row) {
  Scan& s = *static_cast<Scan*>(self);
  const int width = s.survey.cells_.width, here = row + s.survey.up_;
  const int first = std::max(here - s.reach_y, 0);
  const int end = std::min(here + s.reach_y + 1, s.survey.blocks_.height);
  for (int column = 0; column < width; ++column) {
    Extremes reached = s.all;
    if (!s.everywhere) {
      none(reached);
      for (int i = first; i < end; ++i) {
        raise(reached, s.survey.across_[static_cast<std::size_t>(i) * width + column]);
      }
    }
    s.decide_cell(row * width + column, reached);
  }
}

void Survey::Scan::decide_cell(int index, const Extremes& reached) {
  const Own& own = survey.own_[static_cast<std::size_t>(index)];
  CellNeeds& needs = survey.needs_[static_cast<std::size_t>(index)];
  SkippedByBound& by_bound =
      survey.by_bound_[static_cast<std::size_t>(index / survey.cells_.width)];
  if (own.wet == 0) {
    needs = rules.decide({.wet = false, .planes = {}, .reach = {}, .by_bound = by_bound});
    return;
  }
  const auto range = [&](int low, int high) -> Range { return {-reached[low], reached[high]}; };
  const Rect pixels = survey.pixels(index);
  Ranges ranges;
  ranges.surface = {own.surface_near, own.surface_far};
  ranges.own = {own.near, own.far};
  ranges.sink = sink_of(pixels);
  ranges.ray_length.max = 1;
  for (const int x : {pixels.x0, pixels.x1}) {
    for (const int y : {pixels.y0, pixels.y1}) {
      ranges.ray_length.max = std::max(ranges.ray_length.max, glm::length(ray_at(x, y)));
    }
  }
  if (wanted.has(looked_up.depth)) ranges.looked_up = range(kNear, kFar);
  // Depths under the calm surface are known for the dry scene, and where the surface is calm.
  if (everywhere && !looked_up.below && !frame.plane(PlaneId::kSurfaceDepth)) {
    ranges.least_drop = -reached[kDrop];
  }
  if (wanted.has(PlaneId::kShadow)) ranges.shadow = range(kShadowLow, kShadowHigh);
  if (!frame.plane(own_shadow)) ranges.own_shadow = {1, 1};
  if (sees_own_shadow()) ranges.own_shadow = {own.shadow_low, own.shadow_high};
  ranges.shadow_of_water = ranges.own_shadow;
  if (own_shadow == PlaneId::kSurfaceShadow && sees_own_shadow()) {
    // Overscan is not scanned.
    const bool whole = survey.work_.contains(frame.plane(own_shadow).window);
    ranges.shadow_of_water = whole ? shadow_of_water : Range{0, 1};
  }
  for (int c = 0; c < 3 && plan.max_error > 0; ++c) {
    ranges.color[static_cast<std::size_t>(c)] = range(kColorLow + c, kColorHigh + c);
  }
  // Where nothing was hit, the light is 0.
  if (!(ranges.own.max < 1e30 && ranges.looked_up.max < 1e30)) {
    for (Range& c : ranges.color) c = {std::min(c.min, 0.0), std::max(c.max, 0.0)};
  }
  const InReach reach{looked_up.below, -reached[kNear], reached[kFar], own.surface_far,
                      reached[kGap] == 0};
  needs = rules.decide({.wet = true, .planes = ranges, .reach = reach, .by_bound = by_bound});
  needs.grounded = wanted.has(looked_up.depth) && reached[kFar] < 1e30f;
}

Rect Survey::pixels(int index) const {
  const int x = work_.x0 + index % cells_.width * kCell.width;
  const int y = work_.y0 + index / cells_.width * kCell.height;
  return intersection({x, y, x + kCell.width, y + kCell.height}, work_);
}

void Survey::make(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                  const std::string& simd) {
  Scan scan(*this, plan, frame, pass, scan_target(simd));
  scan.lay_out();
  if (!pass.submersible) {
    executor.run(blocks_.height, Scan::scan_row, &scan);
    for (const Own& own : own_) {
      Range& all = scan.shadow_of_water;
      all = {std::min<double>(all.min, own.shadow_low), std::max<double>(all.max, own.shadow_high)};
    }
    Scan::none(scan.all);
    if (scan.everywhere) {
      for (const Extremes& extremes : extremes_) raise(scan.all, extremes);
    } else {
      executor.run(blocks_.height, Scan::reach_across, &scan);
    }
    executor.run(cells_.height, Scan::decide_row, &scan);
  }
  sum_up(plan);
}

void Survey::sum_up(const Plan& plan) {
  summary_ = {};
  for (int i = 0; i < count(); ++i) {
    const CellNeeds& needs = cell(i);
    const std::int64_t area = pixels(i).area();
    const auto add = [&](CellCount& to, bool is) {
      to.cells += is ? 1 : 0;
      to.pixels += is ? area : 0;
    };
    add(summary_.all, true);
    add(summary_.dry, needs.dry);
    add(summary_.opaque, needs.opaque);
    add(summary_.open, needs.open);
    add(summary_.full, needs.skips == 0 && !needs.open);
    for (int op = 0; op < Chain::kCount; ++op) {
      const auto at = static_cast<std::size_t>(op);
      add(summary_.runs[at], plan.keeps(op) && needs.needs(op));
      add(summary_.skipped[at], plan.keeps(op) && !needs.dry && !needs.needs(op));
    }
    summary_.bound = std::max(summary_.bound, double{needs.bound});
  }
  for (const Own& own : own_) summary_.wet += own.wet;
  for (const SkippedByBound& row : by_bound_) {
    summary_.by_bound.operators = summary_.by_bound.operators | row.operators;
    raise(summary_.by_bound.bounds, row.bounds);
  }
}

}  // namespace limpid

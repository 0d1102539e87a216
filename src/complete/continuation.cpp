#include "complete/continuation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "limpid/ops/look.h"

#include "complete/off_frame_sides.h"
#include "complete/row_heights.h"

namespace limpid {
namespace {

constexpr int kEdgeStep = 4;  ///< pixels along an edge between tests for water
constexpr int kColors = 64;   ///< around the edge
/// Distances along the edge, and from it, within which texels count for a color: in widths and
/// heights of the picture.
constexpr double kAlong = 0.15, kDeep = 0.125;
constexpr int kTexelsAlong = 16, kTexelsDeep = 8;
/// Depth of the strip at an edge in which lines are searched, in heights of the picture, and its
/// number of texels.
constexpr double kLinesDeep = 1.0 / 3;
constexpr double kLongest = 64;  ///< pixels, longest distance over which a change is measured
constexpr int kLineSamples = 12288;
/// The direction of the view counts as much as lines with this share of all slopes.
constexpr double kViewCounts = 0.05;
/// Slopes at less than this cosine from the steepest change refine its direction, in several
/// rounds.
constexpr double kNear = 0.8;
constexpr int kRefinements = 4;
/// Range in pixels of the edge's influence: the height of the picture over this.
constexpr double kFade = 24, kSettle = 24;
/// Continuation::inwards of a bottom without lines.
constexpr double kInwards = 1;

float luminance(const Rgb<float>& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

/// The planes that refraction looks up, where they show the bottom.
struct Bottom {
  const Pass& c;
  std::array<View<const float>, 3> color;
  const View<const float>& depth;
  Rect window;

  Bottom(const Frame& frame, const Pass& pass)
      : c(pass), depth(frame.plane(SeenPlanes::of(pass).depth)) {
    const PlaneId red = SeenPlanes::of(pass).color;
    window = depth.window;
    for (int i = 0; i < 3; ++i) {
      const View<const float>& channel = frame.plane(plane_after(red, i));
      color[static_cast<std::size_t>(i)] = channel;
      window = intersection(window, channel.window);
    }
  }
  Rgb<float> color_at(int x, int y) const {
    return {color[0].at(x, y), color[1].at(x, y), color[2].at(x, y)};
  }
  bool wet(int x, int y) const {
    const double z = depth.at(x, y);
    return z < 1e30 && RowHeights(c, y).at(x, z) < 0;
  }
  bool on(const BottomPlane& plane, int x, int y) const {
    if (!window.contains({x, y, x + 1, y + 1})) return false;
    const double z = depth.at(x, y);
    if (!(z < 1e30)) return false;
    const RowHeights heights(c, y);
    return std::abs(heights.at(x, z) - heights.at(x, plane.depth_on(c, x, y))) < plane.slack;
  }
  glm::dvec3 point_at(int x, int y, double z) const {
    const double column = x + 0.5 - c.corner.x, row = y + 0.5 - c.corner.y;
    return c.rays.origin_at(column, row) + z * c.rays.ray_at(column, row);
  }
  glm::dvec2 level_at(const BottomPlane& plane, int x, int y) const {
    const glm::dvec3 p = point_at(x, y, plane.depth_on(c, x, y));
    return {glm::dot(c.t, p), glm::dot(c.b, p)};
  }
  /// Whether what a texel shows is steeper than a bottom, by its neighbours on one side.
  bool is_wall(int x, int y) const {
    if (window.width() < 2 || window.height() < 2) return false;
    const auto seen = [&](int i, int j) { return point_at(i, j, depth.at(i, j)); };
    const glm::dvec3 own = seen(x, y);
    const glm::dvec3 along = seen(x + 1 < window.x1 ? x + 1 : x - 1, y) - own;
    const glm::dvec3 away = seen(x, y + 1 < window.y1 ? y + 1 : y - 1) - own;
    const glm::dvec3 normal = glm::cross(along, away);
    const double up = std::abs(glm::dot(c.up, normal));
    return !(std::hypot(1, BottomPlane::kSteepest) * up > glm::length(normal));
  }
};

/// Relative change of brightness per scene unit along Pass::t and ::b, around a texel of the
/// bottom; nothing at its border. Both over the same length, that of the longer side of the texel,
/// because texels at a grazing angle blur along the view.
std::optional<glm::dvec2> slope_at(const Bottom& bottom, const BottomPlane& plane, int x, int y) {
  const glm::dvec2 at = bottom.level_at(plane, x, y);
  const glm::dmat2 steps(bottom.level_at(plane, x + 1, y) - at,
                         bottom.level_at(plane, x, y + 1) - at);
  const double length = std::max(glm::length(steps[0]), glm::length(steps[1]));
  const glm::dmat2 pixels = length * glm::inverse(steps);
  if (!(std::abs(pixels[0].x) + std::abs(pixels[0].y) + std::abs(pixels[1].x) +
            std::abs(pixels[1].y) <
        kLongest)) {
    return {};
  }
  const auto change = [&](const glm::dvec2& by) -> std::optional<double> {
    const int dx = static_cast<int>(std::lround(by.x)), dy = static_cast<int>(std::lround(by.y));
    if (!bottom.on(plane, x + dx, y + dy) || !bottom.on(plane, x - dx, y - dy)) return {};
    const double after = luminance(bottom.color_at(x + dx, y + dy));
    const double before = luminance(bottom.color_at(x - dx, y - dy));
    return (after - before) / std::max(std::abs(after) + std::abs(before), 1e-6);
  };
  const auto along = change(pixels[0]), away = change(pixels[1]);
  if (!along || !away) return {};
  return glm::dvec2(*along, *away) / length;
}

/// At irregular places, because lines may be regular.
void gather_slopes(const Bottom& bottom, const BottomPlane& plane, const OffFrameLookups& off_frame,
                   std::vector<glm::dvec2>& slopes) {
  const Rect& w = bottom.window;
  const int deep = std::max(2, static_cast<int>(kLinesDeep * w.height()));
  slopes.clear();
  if (w.width() < 3 || w.height() < 3) return;
  std::uint32_t state = 1;  // the same places for the same frame
  const auto any = [&](int begin, int end) {
    state = 1664525u * state + 1013904223u;
    return begin +
           static_cast<int>(std::uint64_t{state} * static_cast<unsigned>(end - begin) >> 32);
  };
  for (int i = 0; i < kLineSamples; ++i) {
    const int x = any(w.x0 + 1, w.x1 - 1), y = any(w.y0 + 1, w.y1 - 1);
    const bool near =
        (off_frame.left > 0 && x < w.x0 + deep) || (off_frame.right > 0 && x >= w.x1 - deep) ||
        (off_frame.top > 0 && y < w.y0 + deep) || (off_frame.bottom > 0 && y >= w.y1 - deep);
    if (!near) continue;
    if (const auto slope = slope_at(bottom, plane, x, y)) slopes.push_back(*slope);
  }
}

/// The direction in which a bottom changes least, along Pass::t and ::b, and how much less than
/// across it: 0 ... 1.
struct Lines {
  glm::dvec2 direction;
  double coherence;
};

struct Tensor {
  double differs, together, all;  ///< along t less along b; both; the sum of both
};

/// Sums over the slopes that `counts` accepts.
template <class Counts>
Tensor tensor_of(const std::vector<glm::dvec2>& slopes, Counts&& counts) {
  Sym2<double> sum{0, 0, 0};
  for (const glm::dvec2& s : slopes) {
    if (counts(s)) sum = sum + Sym2<double>{s.x * s.x, s.x * s.y, s.y * s.y};
  }
  return {sum.xx - sum.yy, 2 * sum.xy, std::max(sum.xx + sum.yy, 1e-12)};
}

/// By the structure tensor (Bigun & Granlund 1987, "Optimal Orientation Detection of Linear
/// Symmetry"), then by the tensor of only those slopes that cross the lines found; away from the
/// viewer if there are no lines.
Lines lines_of(const std::vector<glm::dvec2>& slopes) {
  const Tensor whole = tensor_of(slopes, [](const glm::dvec2&) { return true; });
  const double coherence = std::min(std::hypot(whole.differs, whole.together) / whole.all, 1.0);
  // Twice the angle of the steepest change, and of a change across the view.
  double across = 0.5 * std::atan2(whole.together, whole.differs + kViewCounts * whole.all);
  for (int i = 0; i < kRefinements; ++i) {
    const glm::dvec2 steepest(std::cos(across), std::sin(across));
    const Tensor near = tensor_of(slopes, [&](const glm::dvec2& s) {
      const double along = glm::dot(s, steepest);
      return along * along > kNear * kNear * glm::dot(s, s);
    });
    across = 0.5 * std::atan2(near.together, near.differs + kViewCounts * near.all);
  }
  return {{-std::sin(across), std::cos(across)}, coherence};
}

/// The mean of the middle 40 % by brightness: posts and shadows do not shift it.
Rgb<float> robust_mean(std::vector<Rgb<float>>& colors) {
  std::sort(colors.begin(), colors.end(),
            [](const Rgb<float>& a, const Rgb<float>& b) { return luminance(a) < luminance(b); });
  const std::size_t begin = 3 * colors.size() / 10;
  const std::size_t end = std::max(begin + 1, 7 * colors.size() / 10);
  Rgb<float> sum{0, 0, 0};
  for (std::size_t i = begin; i < end; ++i) sum = sum + colors[i];
  return (1 / static_cast<float>(end - begin)) * sum;
}

/// 0 of none.
double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The place on the edge of a window, in shares of it, and the inward direction.
struct EdgePlace {
  glm::dvec2 at, along, inwards;
};
EdgePlace place_on_edge(double share) {
  const double t = 4 * share, u = t - std::floor(t);
  if (t < 1) return {{u, 0}, {1, 0}, {0, 1}};
  if (t < 2) return {{1, u}, {0, 1}, {-1, 0}};
  if (t < 3) return {{1 - u, 1}, {1, 0}, {0, -1}};
  return {{0, 1 - u}, {0, 1}, {1, 0}};
}

/// Texels under the water near a place of the edge: their colors, and heights over the plane of
/// those of the bottom.
void gather_near(const Bottom& bottom, const BottomPlane& plane, const EdgePlace& edge,
                 std::vector<Rgb<float>>& colors, std::vector<double>& heights) {
  const Rect& w = bottom.window;
  colors.clear(), heights.clear();
  for (int i = 0; i < kTexelsAlong; ++i) {
    for (int j = 0; j < kTexelsDeep; ++j) {
      const double along = kAlong * (2.0 * (i + 0.5) / kTexelsAlong - 1);
      const double deep = kDeep * (j + 0.5) / kTexelsDeep;
      const glm::dvec2 at = edge.at + along * edge.along + deep * edge.inwards;
      if (!(at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1)) continue;
      const int x = std::min(w.x0 + static_cast<int>(at.x * w.width()), w.x1 - 1);
      const int y = std::min(w.y0 + static_cast<int>(at.y * w.height()), w.y1 - 1);
      if (!bottom.wet(x, y)) continue;
      colors.push_back(bottom.color_at(x, y));
      if (bottom.is_wall(x, y)) continue;
      const glm::dvec3 p = bottom.point_at(x, y, bottom.depth.at(x, y));
      heights.push_back(glm::dot(plane.normal, p) - plane.offset);
    }
  }
}

/// What is unknown in a row becomes that of the nearest known place around the edge.
void close_gaps(std::array<View<float>, 3> colors, int row,
                const std::array<bool, kColors>& known) {
  for (int i = 0; i < kColors; ++i) {
    if (known[static_cast<std::size_t>(i)]) continue;
    for (int off = 1; off <= kColors / 2; ++off) {
      const int after = (i + off) % kColors, before = (i + kColors - off) % kColors;
      const bool is_after = known[static_cast<std::size_t>(after)];
      if (!is_after && !known[static_cast<std::size_t>(before)]) continue;
      for (const View<float>& channel : colors) {
        channel.at(i, row) = channel.at(is_after ? after : before, row);
      }
      break;
    }
  }
}

}  // namespace

void ContinuationMaker::paint_edge(const Frame& frame, const Pass& pass, const BottomPlane& plane) {
  const Bottom bottom(frame, pass);
  std::array<View<float>, 3> to;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!colors_[i]) colors_[i] = Plane({0, 0, kColors, 2});
    to[i] = colors_[i].view();
    continuation_.colors.channels[i] = to[i];
  }
  std::array<bool, kColors> known{}, level{};
  for (int i = 0; i < kColors; ++i) {
    gather_near(bottom, plane, place_on_edge((i + 0.5) / kColors), near_, heights_);
    known[static_cast<std::size_t>(i)] = !near_.empty();
    level[static_cast<std::size_t>(i)] = !heights_.empty();
    const Rgb<float> color = near_.empty() ? Rgb<float>{0, 0, 0} : robust_mean(near_);
    to[0].at(i, 0) = color.r;
    to[1].at(i, 0) = color.g;
    to[2].at(i, 0) = color.b;
    to[0].at(i, 1) = static_cast<float>(median(heights_));
    to[1].at(i, 1) = to[2].at(i, 1) = 0;
  }
  close_gaps(to, 0, known);
  close_gaps(to, 1, level);
}

const Continuation* ContinuationMaker::make(const Frame& frame, const Pass& c) {
  const auto plane = fit_bottom(frame, c, samples_);
  if (!plane) return nullptr;
  const OffFrameLookups off_frame = off_frame_sides(*plane, frame, c, kEdgeStep);
  if (!off_frame.any()) return nullptr;
  gather_slopes(Bottom(frame, c), *plane, off_frame, slopes_);
  const Lines lines = lines_of(slopes_);
  const glm::dvec3 level = lines.direction.x * c.t + lines.direction.y * c.b;
  const double rise = -glm::dot(plane->normal, level) / glm::dot(plane->normal, c.up);
  continuation_.normal = plane->normal;
  continuation_.offset = plane->offset;
  continuation_.along = glm::normalize(level + rise * c.up);
  continuation_.least_drop = 0.5 * plane->shallow;
  continuation_.lift = 0.25 * plane->drop;
  // Sand and gravel show some lines by chance.
  const double clear = saturate((lines.coherence - 0.15) / 0.35), loose = 1 - 0.9 * clear;
  continuation_.fade = loose * loose * kFade / c.size.y;
  continuation_.inwards = kInwards * (1 - clear);
  continuation_.settle = kSettle / c.size.y;
  paint_edge(frame, c, *plane);
  return &continuation_;
}

}  // namespace limpid

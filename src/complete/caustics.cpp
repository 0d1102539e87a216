#include "complete/caustics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "limpid/core/simd.h"

#include "complete/row_heights.h"
#include "complete/rows.h"
#include "op/seen_planes.h"
#include "optics/fresnel.h"
#include "optics/refract.h"

namespace limpid {

// One for each instruction set that the build names, defined in caustics_target.cpp.
#define LIMPID_TARGET(name, highway) extern const CausticsTarget kCaustics_##name;
#include "core/targets.inc"
#undef LIMPID_TARGET

namespace {

constexpr const CausticsTarget* kTargets[] = {
#define LIMPID_TARGET(name, highway) &kCaustics_##name,
#include "core/targets.inc"
#undef LIMPID_TARGET
};

constexpr int kLooks = 320;    ///< along the longer side of the picture
constexpr int kWeighed = 160;  ///< likewise, of sunlit bottoms
/// The number of points at which light is followed, of all levels: kPointsOfPixel for each pixel,
/// or kPoints if that is more; at most kMaxPointsOfPixel for each pixel.
constexpr double kPointsOfPixel = 0.5, kPoints = 1e6, kMaxPointsOfPixel = 64;
constexpr std::size_t kEvery = 7;  ///< one bottom of so many is asked for the width of texels
constexpr double kFine = 0.05;     ///< share of the pixels that may want finer texels
constexpr double kSpread = 4;      ///< times the depth at which light begins to fold
/// Likewise: below it, rays two texels apart err less than rays one texel apart, which overlap by
/// roundings, if the shortest wave is at least so many texels long.
constexpr double kSmooth = 0.2, kFinePerWave = 20;
constexpr double kLowSun =
    0.42;  ///< its height as a sine, 25 degrees: below, waves let in more or less

/// The bottom that the dry scene shows below the calm surface, in one row of the picture.
class BottomRow {
 public:
  /// Places go evenly along the row, at the eye and for each unit of depth.
  BottomRow(const Pass& c, const Sunlight& sun, int y, double deepest, bool mirrored)
      : heights_(c, y),
        aside_(sun.aside),
        deepest_(deepest),
        sign_(mirrored ? 1 : -1),
        from_air_(c.eye_above > 0) {
    const double column = 0.5 - c.corner.x, row = y - c.corner.y + 0.5;
    const auto on_map = [&](const glm::dvec3& v) {
      return glm::dvec2(glm::dot(c.map_x, v), glm::dot(c.map_y, v));
    };
    origin_ = on_map(c.rays.origin_at(column, row)), origin_step_ = on_map(c.rays.origin_dx);
    ray_ = on_map(c.rays.ray_at(column, row)), ray_step_ = on_map(c.rays.ray_dx);
  }

  /// Where a view from the air meets no bottom the water is as deep as it may be, if that is known.
  CausticsBottom at(int x, double depth) const {
    const bool hit = depth < 1e30;
    const bool endless = !hit && deepest_ < HUGE_VAL && from_air_;
    const double at = endless ? heights_.depth_at(x, 0) : depth;
    if (!(depth > 0 && at > 0 && at < 1e30)) return {};
    const double bottom = hit ? sign_ * heights_.at(x, at) : deepest_;
    if (!(bottom > 0)) return {};
    const glm::dvec2 point =
        origin_ + double(x) * origin_step_ + at * (ray_ + double(x) * ray_step_);
    const glm::dvec2 let_in = point - (hit ? bottom : 0) * aside_;
    return {static_cast<float>(let_in.x), static_cast<float>(let_in.y),
            static_cast<float>(std::min(bottom, deepest_))};
  }

 private:
  RowHeights heights_;
  glm::dvec2 origin_, origin_step_, ray_, ray_step_, aside_;
  double deepest_, sign_;
  bool from_air_;
};

double deviation_of(const WaveRows& waves, double depth, double focus) {
  return depth * focus * waves.slope();
}

}  // namespace

bool has_fine_depth(const Frame& frame) {
  constexpr std::uint32_t kBeyondHalf = 0x1fff;  // of the digits of a float
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  const Rect& window = depth.window;
  const int step = std::max(4, std::max(window.width(), window.height()) / kWeighed);
  for (int y = window.y0; y < window.y1; y += step) {
    for (int x = window.x0; x < window.x1; x += step) {
      const float value = depth.at(x, y);
      if (value < 1e30f && (std::bit_cast<std::uint32_t>(value) & kBeyondHalf) != 0) return true;
    }
  }
  return false;
}

const CausticsTarget& caustics_target(const std::string& simd) {
  return *kTargets[simd_index(simd)];
}

const CausticsTable* CausticsMaker::make(const WaveNormals::Params* waves,
                                         const Rgb<double>& scattering, const Frame& frame,
                                         const Pass& pass, Executor& executor,
                                         const std::string* simd, double deepest) {
  const CausticsTarget& target = caustics_target(simd ? *simd : "scalar");
  table_.count = 0;
  table_.least = table_.most = 1;
  table_.scale = 1;
  table_.depth = deepest;
  table_.first = within_water() ? CausticsTable::kMaxLevels : 0;
  const glm::dvec3& direction = pass.sun.direction;
  Sunlight sun{};
  sun.to_sun = {glm::dot(direction, pass.map_x), glm::dot(direction, pass.map_y),
                glm::dot(direction, pass.up)};
  if (!pass.has_sun || !(sun.to_sun.z > 1e-3) || !(pass.ior > 1)) return &table_;
  if (!waves || !waves_.make(*waves, frame, pass, executor)) return &table_;
  sun.ior = pass.ior;
  const double sink = refracted_cosine(sun.to_sun.z, 1 / sun.ior);
  sun.aside = glm::dvec2(sun.to_sun) * (-1 / (sun.ior * sink));
  table_.scattered = {scattering.r / sink, scattering.g / sink, scattering.b / sink};
  sun.passes = 1 - fresnel_exact(sun.to_sun.z, sun.ior);
  sun.focus = (sun.ior * sink - sun.to_sun.z) / (sun.ior * sink * sink * sink);
  const double disc = 0.5 * pass.sun.radius();  // the deviation of an even disc
  sun.along = disc * sun.to_sun.z / (sun.ior * sink * sink * sink);
  sun.across = disc / (sun.ior * sink);
  sun.low = sun.to_sun.z < kLowSun;

  look(frame, pass, sun, executor);
  lay_out(waves_, pass, sun);
  if (table_.count == 0) return &table_;
  const int count = table_.count;
  if (!alone_) alone_ = make_executor(1);
  constexpr int kBands = CausticsLevel::kBands;
  const auto level_of = [&](int i) -> CausticsLevel& {
    return levels_[static_cast<std::size_t>(i)];
  };
  run_each(executor, count, [&](int i) { level_of(i).find_bottom(bottoms_, *alone_); });
  run_each(executor, count * kBands,
           [&](int i) { level_of(i / kBands).send(waves_, sun, target, i % kBands); });
  run_each(executor, count * kBands,
           [&](int i) { level_of(i / kBands).finish(sun, target, i % kBands); });
  for (int i = 0; i < count; ++i) {
    const CausticsLevel& level = level_of(i);
    table_.levels[static_cast<std::size_t>(i)] = {level.light(), level.layout().corner,
                                                  level.layout().texel};
    table_.least = std::min(table_.least, level.least());
    table_.most = std::max(table_.most, level.most());
  }
  return &table_;
}

/// Every few pixels: the dry scene's depth below the calm surface, and the footprint on a level
/// bottom at that depth of a pixel of the water. If the eye is in the water, also the bottom that
/// the surface mirrors: it lies as deep as its image stands high.
void CausticsMaker::look(const Frame& frame, const Pass& c, const Sunlight& sun,
                         Executor& executor) {
  const View<const float>& dry = frame.plane(SeenPlanes::of(c).depth);
  const View<const float>& image = frame.plane(PlaneId::kReflectionDepth);
  const bool mirrors = image && c.eye_above < 0 && !within_water();
  step_ = std::max(1, std::max(dry.window.width(), dry.window.height()) / kLooks);
  const auto looks = [&](int pixels) { return (pixels + step_ - 1) / step_; };
  const auto looks_at = [&](const View<const float>& depth) {
    return static_cast<std::size_t>(looks(depth.window.width())) * looks(depth.window.height());
  };
  bottoms_.resize(looks_at(dry) + (mirrors ? looks_at(image) : 0));
  sights_.resize((bottoms_.size() + kEvery - 1) / kEvery);
  const auto take_in = [&](const View<const float>& depth, bool mirrored, std::size_t begin) {
    const int columns = looks(depth.window.width());
    each_row(executor, {0, 0, columns, looks(depth.window.height())}, [&](int row) {
      const int y = depth.window.y0 + row * step_;
      const BottomRow bottoms(c, sun, y, table_.depth, mirrored);
      const std::size_t first = begin + static_cast<std::size_t>(row) * columns;
      for (int column = 0; column < columns; ++column) {
        const int x = depth.window.x0 + column * step_;
        const std::size_t nth = first + static_cast<std::size_t>(column);
        const double far = depth.at(x, y);
        bottoms_[nth] = bottoms.at(x, far);
        if (nth % kEvery == 0) sights_[nth / kEvery] = look_at(c, sun, x, y, far, mirrored);
      }
    });
  };
  take_in(dry, false, 0);
  if (mirrors) take_in(image, true, looks_at(dry));
  // Each level searches all bottoms.
  std::erase_if(bottoms_, [](const CausticsBottom& b) { return !(b.depth > 0); });
  std::erase_if(sights_, [](const CausticsSight& s) { return !(s.depth > 0); });
}

CausticsSight CausticsMaker::look_at(const Pass& c, const Sunlight& sun, int x, int y, double far,
                                     bool mirrored) const {
  const double at_x = x - c.corner.x + 0.5, at_y = y - c.corner.y + 0.5;
  CausticsSight to{};
  const bool hit = far < 1e30;
  if (!(far > 0 && (hit || within_water()))) return to;
  const glm::dvec3 ray = c.rays.ray_at(at_x, at_y), origin = c.rays.origin_at(at_x, at_y);
  const double fall = -glm::dot(c.up, ray), length = glm::length(ray);
  const bool from_air = fall > 0 && c.eye_above > 0;
  if (!hit && !from_air) return to;
  const double begin = from_air ? (c.eye_above + glm::dot(c.up, origin)) / fall : 0;
  const glm::dvec3 point = origin + (hit ? far : begin) * ray;
  const double over = c.eye_above + glm::dot(c.up, point);
  const double bottom = !hit ? table_.depth : mirrored ? over : -over;
  if (!(bottom > 0)) return to;
  const double under = std::min(bottom, table_.depth);
  const auto entry = [&](const glm::dvec3& p, double sunk) {
    return glm::dvec2(glm::dot(c.map_x, p), glm::dot(c.map_y, p)) - sunk * sun.aside;
  };
  to.depth = static_cast<float>(under);
  const double cosine = std::abs(fall) / length;
  glm::dvec3 seen = point, enters = point;
  const double reached = within_water() ? std::min(bottom, 2 * table_.depth) : bottom;
  if (from_air) {
    const double sink = refracted_cosine(cosine, 1 / c.ior);
    const glm::dvec3 level = ray / length + cosine * c.up;
    enters = origin + begin * ray;
    seen = enters + (reached / (c.ior * sink)) * level;
  }
  const glm::dvec2 let_in_seen = entry(seen, reached);
  const glm::dvec2 first = within_water() && from_air ? entry(enters, 0) : let_in_seen;
  to.enters_x = static_cast<float>(first.x), to.enters_y = static_cast<float>(first.y);
  to.seen_x = static_cast<float>(let_in_seen.x), to.seen_y = static_cast<float>(let_in_seen.y);
  to.texel = static_cast<float>(caustics_texel(c, glm::dot(c.forward, seen), cosine));
  return to;
}

/// Texels have a power of two as width and lie on a grid fixed to the world: only the light moves.
/// If that makes too many texels, all pixels take wider texels.
void CausticsMaker::lay_out(const WaveRows& waves, const Pass& pass, const Sunlight& sun) {
  wanted_.clear();
  double deepest = 0, sum = 0;
  for (const CausticsSight& s : sights_) {
    wanted_.push_back(s.texel);
    deepest = std::max<double>(deepest, s.depth);
    sum += s.depth;
  }
  if (wanted_.empty()) return;
  const double mean = sum / static_cast<double>(wanted_.size());
  if (0.9 * deepest * sun.focus * waves.curvature() < kLeastContrast) return;
  const auto fine =
      wanted_.begin() + static_cast<std::ptrdiff_t>(kFine * static_cast<double>(wanted_.size()));
  std::nth_element(wanted_.begin(), fine, wanted_.end());
  const double disc = 2 * mean * std::max(sun.along, sun.across);
  // Views cross the light of the water, and see the mean of much of it.
  const double widest = std::max(waves.shortest(), (within_water() ? 0.5 : 0.1) * waves.longest());
  for (double scale = 1; scale < 1e6; scale *= std::numbers::sqrt2) {
    const double finest = std::max({scale * *fine, disc, 1e-9});
    if (!lay_out(waves, pass, sun, scale, static_cast<int>(std::floor(std::log2(finest))), widest,
                 deepest)) {
      continue;
    }
    table_.scale = scale;
    // Levels that no pixel needs are left out.
    for (CausticsLevel& level : levels_) {
      if (level.empty()) continue;
      std::swap(level, levels_[static_cast<std::size_t>(table_.count)]);
      ++table_.count;
    }
    return;
  }
}

/// False if it would take more points than the picture may have (kMaxPointsOfPixel).
bool CausticsMaker::lay_out(const WaveRows& waves, const Pass& pass, const Sunlight& sun,
                            double scale, int exponent, double widest, double deepest) {
  const glm::dvec2 eye(glm::dot(pass.eye, pass.map_x), glm::dot(pass.eye, pass.map_y));
  for (CausticsLevel& level : levels_) level.leave_out();
  double points = 0;
  for (int i = 0; i < CausticsTable::kMaxLevels; ++i) {
    CausticsLevel::Layout layout;
    const double texel = layout.texel = std::ldexp(1, exponent + i);
    if (texel > widest) break;
    Octagon seen;
    double depth = 0, deep = 0, count = 0;
    for (const CausticsSight& s : sights_) {
      const double wanted = scale * s.texel;
      const bool finer = i > 0 && wanted < 0.5 * texel && !within_water();
      if (wanted > 2 * texel || finer) continue;
      seen.take_in({s.seen_x, s.seen_y});
      if (within_water()) seen.take_in({s.enters_x, s.enters_y});
      depth += s.depth, count += 1;
      deep = std::max<double>(deep, s.depth);
    }
    if (!(count > 0)) continue;
    if (levels_.size() <= static_cast<std::size_t>(i))
      levels_.resize(static_cast<std::size_t>(i) + 1);
    layout.depth = depth / count;
    // Waves move the visible bottom, too.
    seen.widen(6 * texel + 2 * deviation_of(waves, layout.depth, 0.25));
    const auto snapped = [&](double at, double of_eye) {
      return std::floor((at + of_eye) / texel) * texel - of_eye;
    };
    layout.corner = {snapped(seen.low[0], eye.x), snapped(seen.low[1], eye.y)};
    const auto across = [&](double begin, double end) {
      return static_cast<int>(std::min((end - begin) / texel + 2, 1e5));
    };
    layout.size = {across(layout.corner.x, seen.high[0]), across(layout.corner.y, seen.high[1])};
    layout.seen = seen;
    const double aside = 3 * deviation_of(waves, std::min(2 * layout.depth, deepest), sun.focus);
    layout.margin = static_cast<int>(std::min(aside / texel + 2, 64.0));
    // Waves shorter than a texel send light in directions of their own all over it; far below
    // where they focus it, neighbouring rays are farther apart than a ray may be wide. Where they
    // hardly focus it, it is as smooth as they are.
    const double focused = sun.focus * waves.curvature();
    if (texel > waves.shortest() / 3) {
      layout.spacing = 0.25;
    } else if (layout.depth * focused > kSpread) {
      layout.spacing = 0.5;
    } else if (deep * focused < kSmooth && texel < waves.shortest() / kFinePerWave) {
      layout.spacing = 2;
    }
    layout.coarse = step_ < 4 ? 2 : 4;
    CausticsLevel& level = levels_[static_cast<std::size_t>(i)];
    level.lay_out(layout);
    points += level.points();
  }
  const double pixels = double(pass.size.x) * pass.size.y;
  return points <= std::min(std::max(kPoints, kPointsOfPixel * pixels), kMaxPointsOfPixel * pixels);
}

}  // namespace limpid

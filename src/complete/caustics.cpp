#include "complete/caustics.h"

#include <algorithm>
#include <cmath>
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

// One for each instruction set that the build names, made by caustics_target.cpp.
#define LIMPID_TARGET(name, highway) extern const CausticsTarget kCaustics_##name;
#include "core/targets.inc"
#undef LIMPID_TARGET

namespace {

constexpr const CausticsTarget* kTargets[] = {
#define LIMPID_TARGET(name, highway) &kCaustics_##name,
#include "core/targets.inc"
#undef LIMPID_TARGET
};

constexpr int kLooks = 320;       ///< along the longer side of the picture
constexpr double kMostSun = 100;  ///< over the rest of the light, where that is almost nothing
/// At which light is followed, of all levels: for each pixel, and at least as many as these; but no
/// more than 64 for each pixel.
constexpr double kPointsOfPixel = 2, kPoints = 1e6, kMostPointsOfPixel = 64;
constexpr std::size_t kEvery = 7;  ///< of these is asked how wide texels shall be
constexpr double kFine = 0.05;     ///< share of the pixels that may want finer texels
constexpr float kOfEdge = 1.2f;    ///< what is deeper than so many times the edge is not of it
constexpr double kLowSun =
    0.42;  ///< its height as a sine, 25 degrees: below, waves let in more or less

double deviation_of(const WaveRows& waves, double depth, double focus) {
  return depth * focus * waves.slope();
}

}  // namespace

const CausticsTarget& caustics_target(const std::string& simd) {
  return *kTargets[simd_index(simd)];
}

const CausticsTable* CausticsMaker::make(const WaveNormals::Params& waves,
                                         const Rgb<double>& scattering, const Frame& frame,
                                         const Pass& pass, Executor& executor,
                                         const std::string* simd, double deepest) {
  const CausticsTarget& target = caustics_target(simd ? *simd : "scalar");
  table_.count = 0;
  table_.least = table_.most = 1;
  table_.scale = 1;
  table_.depth = deepest;
  table_.first = within_water() ? CausticsTable::kMostLevels : 0;
  const glm::dvec3& direction = pass.sun.direction;
  Sunlight sun{};
  sun.to_sun = {glm::dot(direction, pass.map_x), glm::dot(direction, pass.map_y),
                glm::dot(direction, pass.up)};
  if (!pass.has_sun || !(sun.to_sun.z > 1e-3) || !(pass.ior > 1)) return &table_;
  if (!within_water()) weigh_sun(frame, pass);
  if (!waves_.make(waves, frame, pass, executor)) return &table_;
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
  run_each(executor, count,
           [&](int i) { find_bottom(levels_[static_cast<std::size_t>(i)], *alone_); });
  run_each(executor, count * kBands, [&](int i) {
    splat(waves_, sun, target, levels_[static_cast<std::size_t>(i / kBands)], i % kBands);
  });
  run_each(executor, count, [&](int i) { finish(sun, levels_[static_cast<std::size_t>(i)]); });
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const Level& level = levels_[index];
    const View<const float> light = level.light.view();
    table_.levels[index] = {light, level.corner, level.texel};
    for (int y = 0; y < level.size.height; ++y) {
      const float* row = light.row(y);
      const auto [least, most] = std::minmax_element(row, row + level.size.width);
      table_.least = std::min<double>(table_.least, *least);
      table_.most = std::max<double>(table_.most, *most);
    }
  }
  return &table_;
}

/// Over bottoms that are lit, every few pixels.
void CausticsMaker::weigh_sun(const Frame& frame, const Pass& c) {
  table_.sun_over_rest = {};
  if (!c.planes.covers(kSunColorPlanes | PlaneSet{PlaneId::kShadow})) return;
  constexpr int kStep = 4;
  constexpr float kLit = 0.95f;
  const Rect work = frame.work();
  std::array<double, 3> sun{}, rest{};
  for (int y = work.y0; y < work.y1; y += kStep) {
    const RowHeights heights(c, y);
    for (int x = work.x0; x < work.x1; x += kStep) {
      const double depth = frame.plane(PlaneId::kDepth).at(x, y);
      if (!(depth < 1e30 && heights.at(x, depth) < 0)) continue;
      if (frame.plane(PlaneId::kShadow).at(x, y) < kLit) continue;
      for (int k = 0; k < 3; ++k) {
        const double whole = frame.plane(plane_after(PlaneId::kColorR, k)).at(x, y);
        const double direct = frame.plane(plane_after(PlaneId::kSunColorR, k)).at(x, y);
        sun[static_cast<std::size_t>(k)] += std::clamp(direct, 0.0, std::max(whole, 0.0));
        rest[static_cast<std::size_t>(k)] += std::max(whole - std::max(direct, 0.0), 0.0);
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    table_.sun_over_rest[k] = rest[k] > 0 ? std::min(sun[k] / rest[k], kMostSun) : 0;
  }
}

/// At each few pixels: what the dry scene shows below the calm surface, and what a pixel of the
/// water sees of a level bottom that deep.
void CausticsMaker::look(const Frame& frame, const Pass& c, const Sunlight& sun,
                         Executor& executor) {
  const View<const float>& depth = frame.plane(SeenPlanes::of(c).depth);
  const Rect window = depth.window;
  const int step = std::max(1, std::max(window.width(), window.height()) / kLooks);
  const int columns = (window.width() + step - 1) / step,
            rows = (window.height() + step - 1) / step;
  samples_.resize(static_cast<std::size_t>(columns) * rows);
  each_row(executor, {0, 0, columns, rows}, [&](int row) {
    Sample* to = samples_.data() + static_cast<std::size_t>(row) * columns;
    const int y = window.y0 + row * step;
    const double at_y = y - c.corner.y + 0.5;
    for (int column = 0; column < columns; ++column, ++to) {
      const int x = window.x0 + column * step;
      const double at_x = x - c.corner.x + 0.5, far = depth.at(x, y);
      *to = {};
      const bool hit = far < 1e30;
      if (!(far > 0 && (hit || within_water()))) continue;
      const glm::dvec3 ray = c.rays.ray_at(at_x, at_y), origin = c.rays.origin_at(at_x, at_y);
      const double fall = -glm::dot(c.up, ray), length = glm::length(ray);
      const bool from_air = fall > 0 && c.eye_above > 0;
      if (!hit && !from_air) continue;
      const double begin = from_air ? (c.eye_above + glm::dot(c.up, origin)) / fall : 0;
      const glm::dvec3 point = origin + (hit ? far : begin) * ray;
      const double bottom = hit ? -(c.eye_above + glm::dot(c.up, point)) : table_.depth;
      if (!(bottom > 0)) continue;
      const double under = std::min(bottom, table_.depth);
      const auto entry = [&](const glm::dvec3& p, double sunk) {
        return glm::dvec2(glm::dot(c.map_x, p), glm::dot(c.map_y, p)) - sunk * sun.aside;
      };
      const glm::dvec2 let_in = entry(point, hit ? bottom : 0);
      to->x = static_cast<float>(let_in.x), to->y = static_cast<float>(let_in.y);
      to->depth = static_cast<float>(under);
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
      to->enters_x = static_cast<float>(first.x), to->enters_y = static_cast<float>(first.y);
      to->seen_x = static_cast<float>(let_in_seen.x),
      to->seen_y = static_cast<float>(let_in_seen.y);
      to->texel = static_cast<float>(caustics_texel(c, glm::dot(c.forward, seen), cosine));
    }
  });
}

/// Texels are powers of two wide and lie on a grid that stays with the world: what moves is the
/// light. Where that makes too many texels, all pixels take wider ones.
void CausticsMaker::lay_out(const WaveRows& waves, const Pass& pass, const Sunlight& sun) {
  wanted_.clear();
  double deepest = 0, sum = 0;
  for (std::size_t k = 0; k < samples_.size(); k += kEvery) {
    const Sample& s = samples_[k];
    if (!(s.depth > 0)) continue;
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
  // Views go across the light of the water, and see the mean of much of it.
  const double widest = std::max(waves.shortest(), (within_water() ? 0.5 : 0.1) * waves.longest());
  for (double scale = 1; scale < 1e6; scale *= std::numbers::sqrt2) {
    const double finest = std::max({scale * *fine, disc, 1e-9});
    if (!lay_out(waves, pass, sun, scale, static_cast<int>(std::floor(std::log2(finest))), widest,
                 deepest)) {
      continue;
    }
    table_.scale = scale;
    // Levels that no pixel asks for are left out.
    for (Level& level : levels_) {
      if (level.size.width == 0) continue;
      std::swap(level, levels_[static_cast<std::size_t>(table_.count)]);
      ++table_.count;
    }
    return;
  }
}

/// False where it would take more points than kPoints.
bool CausticsMaker::lay_out(const WaveRows& waves, const Pass& pass, const Sunlight& sun,
                            double scale, int exponent, double widest, double deepest) {
  const glm::dvec2 eye(glm::dot(pass.eye, pass.map_x), glm::dot(pass.eye, pass.map_y));
  for (Level& level : levels_) level.size = {0, 0};
  double points = 0;
  for (int i = 0; i < CausticsTable::kMostLevels; ++i) {
    const double texel = std::ldexp(1, exponent + i);
    if (texel > widest) break;
    glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
    double depth = 0, seen = 0;
    for (std::size_t k = 0; k < samples_.size(); k += kEvery) {
      const Sample& s = samples_[k];
      const double wanted = scale * s.texel;
      const bool finer = i > 0 && wanted < 0.5 * texel && !within_water();
      if (!(s.depth > 0) || wanted > 2 * texel || finer) continue;
      for (const glm::dvec2 at : {glm::dvec2(s.seen_x, s.seen_y), {s.enters_x, s.enters_y}}) {
        low = glm::min(low, at), high = glm::max(high, at);
      }
      depth += s.depth, seen += 1;
    }
    if (!(seen > 0)) continue;
    if (levels_.size() <= static_cast<std::size_t>(i))
      levels_.resize(static_cast<std::size_t>(i) + 1);
    Level& level = levels_[static_cast<std::size_t>(i)];
    level.texel = texel;
    level.depth = depth / seen;
    // Waves move what is seen, too.
    const double around = 6 * texel + 2 * deviation_of(waves, level.depth, 0.25);
    const auto snapped = [&](double at, double of_eye) {
      return std::floor((at - around + of_eye) / texel) * texel - of_eye;
    };
    level.corner = {snapped(low.x, eye.x), snapped(low.y, eye.y)};
    const auto across = [&](double begin, double end) {
      return static_cast<int>(std::min((end + around - begin) / texel + 2, 1e5));
    };
    level.size = {across(level.corner.x, high.x), across(level.corner.y, high.y)};
    const double aside = 3 * deviation_of(waves, std::min(2 * level.depth, deepest), sun.focus);
    level.margin = static_cast<int>(std::min(aside / texel + 2, 64.0));
    // Waves shorter than a texel send light in directions of their own all over it.
    level.density = texel / 2 > waves.shortest() / 6 ? 4 : 2;
    points += double(level.density) * level.density * (level.size.width + 2.0 * level.margin) *
              (level.size.height + 2.0 * level.margin);
  }
  const double pixels = double(pass.size.x) * pass.size.y;
  return points <=
         std::min(std::max(kPoints, kPointsOfPixel * pixels), kMostPointsOfPixel * pixels);
}

/// Means of what is seen in each cell, drawn on over those in which nothing is. Where the upper
/// edge of a cliff shades its foot light meets the edge.
void CausticsMaker::find_bottom(Level& level, Executor& executor) const {
  const int margin = level.margin + kCoarse;
  level.cells = {(level.size.width + 2 * margin) / kCoarse + 2,
                 (level.size.height + 2 * margin) / kCoarse + 2};
  auto& cells = level.filled.finest(level.cells);
  std::fill(cells.texels.begin(), cells.texels.end(), PullPush<1>::Texel{});
  level.bottom.assign(cells.texels.size(), std::numeric_limits<float>::infinity());
  const float per_cell = static_cast<float>(1 / (kCoarse * level.texel));
  const float first_x = static_cast<float>(level.corner.x) - float(margin) / kCoarse / per_cell;
  const float first_y = static_cast<float>(level.corner.y) - float(margin) / kCoarse / per_cell;
  const auto each_inside = [&](auto&& visit) {
    for (const Sample& s : samples_) {
      if (!(s.depth > 0)) continue;
      const float x = (s.x - first_x) * per_cell, y = (s.y - first_y) * per_cell;
      if (!(x >= 0 && y >= 0 && x < static_cast<float>(level.cells.width) &&
            y < static_cast<float>(level.cells.height))) {
        continue;
      }
      visit(s.depth, static_cast<std::size_t>(y) * level.cells.width + static_cast<std::size_t>(x));
    }
  };
  each_inside([&](float depth, std::size_t cell) {
    level.bottom[cell] = std::min(level.bottom[cell], depth);
  });
  each_inside([&](float depth, std::size_t cell) {
    if (depth > kOfEdge * level.bottom[cell]) return;
    cells.texels[cell][0] += depth;
    cells.texels[cell][1] += 1;
  });
  for (auto& cell : cells.texels) {
    if (cell[1] > 0) cell = {cell[0] / cell[1], 1};
  }
  if (!level.filled.draw_on(executor)) {
    std::fill(level.bottom.begin(), level.bottom.end(), static_cast<float>(level.depth));
    return;
  }
  const auto& whole = level.filled.finest().texels;
  std::transform(whole.begin(), whole.end(), level.bottom.begin(),
                 [](const auto& cell) { return cell[0]; });
}

/// A grid of rays, a part of a texel apart; a band has some of its rows.
void CausticsMaker::splat(const WaveRows& waves, const Sunlight& sun, const CausticsTarget& target,
                          Level& level, int band) const {
  Band& kept = level.bands[static_cast<std::size_t>(band)];
  std::vector<float>& light = kept.light;
  const Size size = level.size;
  const int stride = size.width + 2;
  light.assign(static_cast<std::size_t>(stride) * (size.height + 2), 0.0f);
  const int density = level.density;
  const int across = (size.width + 2 * level.margin) * density;
  const int down = (size.height + 2 * level.margin) * density;
  const int begin = static_cast<int>(std::int64_t{down} * band / kBands);
  const int end = static_cast<int>(std::int64_t{down} * (band + 1) / kBands);
  constexpr int kRoom = 16;  // a vector may end beyond the row
  const std::ptrdiff_t whole = across + kRoom;
  kept.rows.resize(7 * static_cast<std::size_t>(whole));
  kept.texels.resize(static_cast<std::size_t>(whole));
  const auto row_at = [&](int i) { return kept.rows.data() + i * whole; };
  const SurfaceRow surface{row_at(0), row_at(1), row_at(2)};
  const SplatRow to{kept.texels.data(), row_at(3), row_at(4), row_at(5), row_at(6)};

  const double own = 1.0 / density, step = level.texel * own;
  const double first = (0.5 * own - 0.5) - level.margin;
  LightRow job{.sun_x = static_cast<float>(sun.to_sun.x),
               .sun_y = static_cast<float>(sun.to_sun.y),
               .sun_z = static_cast<float>(sun.to_sun.z),
               .ior = static_cast<float>(sun.ior),
               .eta = static_cast<float>(1 / sun.ior),
               .per_calm = static_cast<float>(sun.low ? 1 / sun.passes : 0),
               .calm_x = static_cast<float>(sun.aside.x),
               .calm_y = static_cast<float>(sun.aside.y),
               .share = static_cast<float>(own * own / sun.to_sun.z),
               .per_length = static_cast<float>(1 / level.texel),
               .first_x = static_cast<float>(first),
               .step_x = static_cast<float>(own),
               .at_y = 0,
               .bottom = level.bottom.data(),
               .across = level.cells.width,
               .down = level.cells.height,
               .per_cell = 1.0f / kCoarse,
               .cell_x = float(level.margin + kCoarse) / kCoarse - 0.5f,
               .width = size.width,
               .height = size.height};
  for (int row = begin; row < end; ++row) {
    const double at_y = first + row * own;
    job.at_y = static_cast<float>(at_y);
    waves.row(level.corner.x + first * level.texel, level.corner.y + at_y * level.texel, step,
              across, target, kept.sines, surface);
    target.follow(job, across, surface, to);
    for (int i = 0; i < across; ++i) {
      float* texel = light.data() + to.texel[i];
      texel[0] += to.here[i];
      texel[1] += to.right[i];
      texel[stride] += to.below[i];
      texel[stride + 1] += to.beside[i];
    }
  }
}

/// The sum of the bands; [v/2, 1 - v, v/2] along each axis, where v is the variance of the sun's
/// disc on the bottom, in texels, less that of the two bilinear blurs.
void CausticsMaker::finish(const Sunlight& sun, Level& level) const {
  const Size size = level.size;
  if (!level.light || level.light.view().window != rect_of(size))
    level.light = Plane(rect_of(size));
  std::vector<float>& sum = level.bands[0].light;
  for (int band = 1; band < kBands; ++band) {
    const std::vector<float>& more = level.bands[static_cast<std::size_t>(band)].light;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
  }
  const double level_square = 1 - sun.to_sun.z * sun.to_sun.z;
  const double ahead_x = level_square > 1e-12 ? sun.to_sun.x * sun.to_sun.x / level_square : 0.5;
  const double along = sun.along * sun.along, across = sun.across * sun.across;
  const auto spread = [&](double ahead) {
    return static_cast<float>((along * ahead + across * (1 - ahead)) / (level.texel * level.texel));
  };
  const float spread_x = spread(ahead_x), spread_y = spread(1 - ahead_x);
  const auto blur_of = [](float of_disc, float depth) {
    return std::min(of_disc * depth * depth - 1.0f / 3, 2.0f / 3);
  };
  const auto depth_at = [&](int x, int y) {
    const int cell_x = (x + level.margin + kCoarse) / kCoarse;
    const int cell_y = (y + level.margin + kCoarse) / kCoarse;
    return level.bottom[static_cast<std::size_t>(cell_y) * level.cells.width + cell_x];
  };
  const View<float> to = level.light.view();
  std::vector<float>& rows = level.bands[1].light;
  const std::ptrdiff_t stride = size.width + 2;
  for (int y = 0; y < size.height; ++y) {
    const float* from = sum.data() + (y + 1) * stride + 1;
    float* half = rows.data() + std::ptrdiff_t{y} * size.width;
    for (int x = 0; x < size.width; ++x) {
      const float v = blur_of(spread_x, depth_at(x, y));
      const float left = from[std::max(x - 1, 0)], right = from[std::min(x + 1, size.width - 1)];
      half[x] = (1 - v) * from[x] + 0.5f * v * (left + right);
    }
  }
  for (int y = 0; y < size.height; ++y) {
    const auto row = [&](int at) {
      return rows.data() +
             static_cast<std::ptrdiff_t>(std::clamp(at, 0, size.height - 1)) * size.width;
    };
    const float *above = row(y - 1), *here = row(y), *below = row(y + 1);
    float* out = to.row(y);
    for (int x = 0; x < size.width; ++x) {
      const float v = blur_of(spread_y, depth_at(x, y));
      out[x] = (1 - v) * here[x] + 0.5f * v * (above[x] + below[x]);
    }
  }
}

}  // namespace limpid

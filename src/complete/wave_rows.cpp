#include "complete/wave_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "complete/rows.h"
#include "op/plain_textures.h"

namespace limpid {
namespace {

/// Places of the surface as pixels for the operator wave_normals. There is no frame: planes read as
/// absent planes do.
class Places : public PlainTextures<Places> {
 public:
  using Number = double;

  explicit Places(std::span<Pixel<double>> pixels) : pixels_(pixels) {}

  template <class Fn>
  void each(Fn&& fn) {
    for (Pixel<double>& p : pixels_) fn(p);
  }
  template <class Into>
  void own3(PlaneId, Into&& into) {
    for (Pixel<double>& p : pixels_) into(p, Vec3<double>{0, 0, 0});
  }
  template <class Into>
  void around3(PlaneId, Into&& into) {
    for (Pixel<double>& p : pixels_) into(p, Around<double>{});
  }

 private:
  std::span<Pixel<double>> pixels_;
};

/// A vertical surface gets the slope of the steepest waves.
constexpr double kLeastUp = 0.05;

/// Along map_x and map_y.
Vec2<double> slopes_of(const Pass& c, const Vec3<double>& n) {
  const double up = std::max(dot(n, vec3_of<double>(c.up)), kLeastUp);
  return {-dot(n, vec3_of<double>(c.map_x)) / up, -dot(n, vec3_of<double>(c.map_y)) / up};
}

}  // namespace

bool WaveRows::make(const WaveNormals::Params& waves, const Frame& frame, const Pass& pass,
                    Executor& executor) {
  frame_ = &frame, pass_ = &pass;
  raised_ = pass.raised;
  sines_.clear();
  slope_ = curvature_ = 0;
  shortest_ = HUGE_VAL, longest_ = 0;
  const bool of_scene =
      waves.model == WaveNormals::Model::kPlate && waves.waves.empty() && !pass.waves.empty();
  if (waves.model == WaveNormals::Model::kSines) {
    take_sines(waves.waves.empty() ? pass.waves : waves.waves, waves.strength);
  } else if (of_scene) {
    take_sines(pass.waves, 1);
  } else if (waves.model == WaveNormals::Model::kPlate) {
    source_ = Source::kNormals;
    if (frame.present().covers(kSurfaceNormalPlanes)) measure_normals();
  } else if (frame.wave_map) {
    source_ = Source::kTile;
    make_tile(waves, executor);
    measure_tile();
  }
  return slope_ > 0;
}

void WaveRows::take_sines(std::span<const SineWave> waves, double strength) {
  source_ = Source::kSines;
  double slope = 0, curvature = 0;
  for (SineWave wave : waves) {
    const double k = std::hypot(wave.k_x, wave.k_y);
    wave.amplitude *= strength;
    if (!(wave.amplitude != 0 && k > 0)) continue;
    sines_.push_back(wave);
    const double steepness = wave.amplitude * k;
    slope += 0.5 * steepness * steepness;
    curvature += 0.5 * steepness * steepness * k * k;
    shortest_ = std::min(shortest_, 2 * std::numbers::pi / k);
    longest_ = std::max(longest_, 2 * std::numbers::pi / k);
  }
  slope_ = std::sqrt(slope), curvature_ = std::sqrt(curvature);
}

void WaveRows::row(double x, double y, double step, int count, const CausticsTarget& target,
                   Room& room, const SurfaceRow& to) const {
  std::fill_n(to.height, count, 0.0f);
  if (source_ == Source::kTile) return row_of_tile(x, y, step, count, target, room.tile, to);
  if (source_ == Source::kNormals) return row_of_normals(x, y, step, count, target, to);
  std::fill_n(to.slope_x, count, 0.0f);
  std::fill_n(to.slope_y, count, 0.0f);
  room.sines.clear();
  for (const SineWave& wave : sines_) {
    room.sines.push_back({pass_->phase_at_eye(wave) + wave.k_y * y + wave.k_x * x, wave.k_x * step,
                          static_cast<float>(raised_ ? wave.amplitude : 0),
                          static_cast<float>(wave.amplitude * wave.k_x),
                          static_cast<float>(wave.amplitude * wave.k_y)});
  }
  target.add_sines(room.sines, count, to);
}

// --- maps ---------------------------------------------------------------------------------------

/// One period of the model's sum over the map; two_flows looks up one of its maps at half the
/// density.
void WaveRows::make_tile(const WaveNormals::Params& waves, Executor& executor) {
  const Pass& c = *pass_;
  WaveNormals::Params plain = waves;
  plain.filter = WaveNormals::Filter::kNone;
  period_ = waves.tile_size * (waves.model == WaveNormals::Model::kTwoFlows ? 2 : 1);
  const auto place = [&](const glm::dvec3& axis) {
    const double at = std::fmod(glm::dot(c.eye, axis), period_);
    return at < 0 ? at + period_ : at;
  };
  tile_at_ = {place(c.map_x), place(c.map_y)};
  tile_.resize(2 * static_cast<std::size_t>(kTile + 1) * (kTile + 1));
  if (Kernel<WaveNormals>::needs_slope_map(waves) && frame_->wave_slopes && !(waves.wind > 0)) {
    if (copy_tile(*frame_->wave_slopes, -waves.strength)) return;
  }
  const Vec3<double> up = vec3_of<double>(c.up);
  each_row(executor, {0, 0, kTile + 1, kTile + 1}, [&](int y) {
    std::array<Pixel<double>, kTile + 1> pixels{};
    for (int x = 0; x <= kTile; ++x) {
      Pixel<double>& p = pixels[static_cast<std::size_t>(x)];
      const glm::dvec3 point = (period_ * (x + 0.5) / kTile - tile_at_.x) * c.map_x +
                               (period_ * (y + 0.5) / kTile - tile_at_.y) * c.map_y -
                               c.eye_above * c.up;
      p.surface_point = vec3_of<double>(point);
      p.normal = p.to_viewer = up;
      p.side = 1;
    }
    Places places(pixels);
    Kernel<WaveNormals>::apply(plain, c, places);
    float* to = tile_.data() + 2 * static_cast<std::size_t>(y) * (kTile + 1);
    for (const Pixel<double>& p : pixels) {
      const Vec2<double> slope = slopes_of(c, p.normal);
      *to++ = static_cast<float>(slope.x);
      *to++ = static_cast<float>(slope.y);
    }
  });
}

/// Copies a level of the same size, if there is one: four lookups per texel would take longer than
/// the rest of the table.
bool WaveRows::copy_tile(const SlopeLevels& slopes, double scale) {
  const LevelSizes& sizes = slopes.sizes;
  int level = 0;
  while (level < sizes.count && sizes.size(level) != Size{kTile, kTile}) ++level;
  if (level == sizes.count) return false;
  const float times = static_cast<float>(scale);
  float* to = tile_.data();
  for (int y = 0; y <= kTile; ++y) {
    const float *along_x = slopes.planes[0] + sizes.place(level, 0, y),
                *along_y = slopes.planes[1] + sizes.place(level, 0, y);
    for (int x = 0; x <= kTile; ++x) *to++ = times * along_x[x], *to++ = times * along_y[x];
  }
  return true;
}

void WaveRows::measure_tile() {
  double slope = 0, change = 0, mean_x = 0, mean_y = 0;
  const auto at = [&](int x, int y) {
    return tile_.data() + 2 * (static_cast<std::ptrdiff_t>(y) * (kTile + 1) + x);
  };
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      const float *here = at(x, y), *right = at(x + 1, y), *below = at(x, y + 1);
      slope += here[0] * here[0] + here[1] * here[1];
      mean_x += here[0], mean_y += here[1];
      const double gained = (right[0] - here[0]) + (below[1] - here[1]);
      change += gained * gained;
    }
  }
  const double texel = period_ / kTile, count = double(kTile) * kTile;
  mean_x /= count, mean_y /= count;
  slope_ = std::sqrt(slope / count);
  const double varies = std::sqrt(std::max(slope / count - mean_x * mean_x - mean_y * mean_y, 0.0));
  curvature_ = std::sqrt(change / count) / texel;
  shortest_ = std::max(4 * texel, curvature_ > 0 ? 2 * std::numbers::pi * varies / curvature_ : 0);
  longest_ = period_;
}

void WaveRows::row_of_tile(double x, double y, double step, int count, const CausticsTarget& target,
                           std::vector<float>& room, const SurfaceRow& to) const {
  const auto wrapped = [&](double at) {  // a texel's place is its middle
    const double turns = at / period_ - 0.5 / kTile;
    return (turns - std::floor(turns)) * kTile;
  };
  constexpr std::size_t kRow = 2 * (kTile + 1);
  const double row = wrapped(y + tile_at_.y);
  const int y0 = std::min(static_cast<int>(row), kTile - 1);
  const float v = static_cast<float>(row - y0);
  const float* upper = tile_.data() + static_cast<std::size_t>(y0) * kRow;
  room.resize(kRow);
  for (std::size_t i = 0; i < kRow; ++i) room[i] = upper[i] + v * (upper[i + kRow] - upper[i]);
  target.read_tile({room.data(), kTile, wrapped(x + tile_at_.x), step * kTile / period_}, count,
                   to);
}

// --- the frame's own normals --------------------------------------------------------------------

void WaveRows::measure_normals() {
  const Pass& c = *pass_;
  const Rect window = frame_->plane(PlaneId::kSurfaceNormalX).window;
  const auto slopes = [&](int x, int y) {
    const auto at = [&](int k) -> double {
      return frame_->plane(plane_after(PlaneId::kSurfaceNormalX, k)).at(x, y);
    };
    return slopes_of(c, {at(0), at(1), at(2)});
  };
  constexpr int kStep = 4;
  double slope = 0, change = 0, count = 0;
  for (int y = window.y0; y + 1 < window.y1; y += kStep) {
    const RowRays<double> rays(c, y - c.corner.y + 0.5);
    for (int x = window.x0; x + 1 < window.x1; x += kStep) {
      const double depth = rays.calm_depth(x - c.corner.x + 0.5);
      if (!(depth < 1e30)) continue;
      const double pixel = glm::length(c.rays.origin_dx) + depth * glm::length(c.rays.ray_dx);
      const Vec2<double> here = slopes(x, y), right = slopes(x + 1, y);
      slope += here.x * here.x + here.y * here.y;
      const double over = std::hypot(right.x - here.x, right.y - here.y) / std::max(pixel, 1e-30);
      change += over * over;
      count += 1;
    }
  }
  if (!(count > 0)) return;
  slope_ = std::sqrt(slope / count);
  curvature_ = std::sqrt(change / count);
  shortest_ = curvature_ > 0 ? 2 * std::numbers::pi * slope_ / curvature_ : HUGE_VAL;
  longest_ = 16 * shortest_;
}

void WaveRows::row_of_normals(double x, double y, double step, int count,
                              const CausticsTarget& target, const SurfaceRow& to) const {
  const Pass& c = *pass_;
  NormalRow row;
  for (int k = 0; k < 3; ++k) {
    row.normal[k] = frame_->plane(plane_after(PlaneId::kSurfaceNormalX, k));
  }
  Rect window = row.normal[0].window;
  for (const View<const float>& view : row.normal) window = intersection(window, view.window);
  for (View<const float>& view : row.normal) {
    view.data = &view.at(window.x0, window.y0);
    view.window = window;
  }
  row.map_x = vec3_of<float>(c.map_x), row.map_y = vec3_of<float>(c.map_y);
  row.up = vec3_of<float>(c.up), row.least_up = static_cast<float>(kLeastUp);
  // From the picture's corner, where uv is 0.
  const glm::dvec3 first = x * c.map_x + y * c.map_y - c.eye_above * c.up - c.rays.origin;
  const auto along = [&](const glm::dvec3& axis, double times) {
    return EvenRow{times * glm::dot(axis, first), times * step * glm::dot(axis, c.map_x)};
  };
  const auto moved = [&](EvenRow at, double texels) {
    return EvenRow{at.first + texels * row.w.first, at.step + texels * row.w.step};
  };
  row.w = along(c.forward, c.w_depth);
  row.w.first += c.w_origin;
  row.u = moved(along(c.to_u, c.size.x), c.corner.x - 0.5 - window.x0);
  row.v = moved(along(c.to_v, c.size.y), c.corner.y - 0.5 - window.y0);
  target.read_normals(row, count, to);
}

}  // namespace limpid

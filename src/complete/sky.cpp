#include "complete/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "complete/rows.h"
#include "optics/clear_sky.h"

namespace limpid {
namespace {

using Texel = PullPush<3>::Texel;

struct Picture {
  std::array<View<const float>, 3> color;
  View<const float> alpha, depth;
  Rect window;  ///< where both color and depth are

  explicit Picture(const Frame& frame)
      : color{frame.plane(PlaneId::kColorR), frame.plane(PlaneId::kColorG),
              frame.plane(PlaneId::kColorB)},
        alpha(frame.plane(PlaneId::kColorA)),
        depth(frame.plane(PlaneId::kDepth)),
        window(intersection(color[0].window, depth.window)) {
    for (const View<const float>& view : color) window = intersection(window, view.window);
    if (alpha) window = intersection(window, alpha.window);
  }

  bool is_sky(int x, int y) const {
    return !(depth.at(x, y) < 1e30f) && !(alpha && alpha.at(x, y) < 0.5f);
  }
  /// Sky beside no object: in the color of other texels of the sky may be a part of an object,
  /// because depth is from one sample of many.
  bool is_clear(int x, int y) const {
    for (int j = std::max(y - 1, window.y0); j < std::min(y + 2, window.y1); ++j) {
      for (int i = std::max(x - 1, window.x0); i < std::min(x + 2, window.x1); ++i) {
        if (!is_sky(i, j)) return false;
      }
    }
    return true;
  }
  /// Sky that is not clear counts where there is no other around.
  Texel sky_at(int x, int y) const {
    constexpr float kBesideObject = 1e-5f;
    if (!is_sky(x, y)) return {};
    return {color[0].at(x, y), color[1].at(x, y), color[2].at(x, y),
            is_clear(x, y) ? 1 : kBesideObject};
  }
};

}  // namespace

bool Sky::make(const Frame& frame, Executor& executor) {
  const Picture picture(frame);
  sky_.begin(picture.window.size(), executor, [&](int x, int y) {
    return picture.sky_at(picture.window.x0 + x, picture.window.y0 + y);
  });
  if (!sky_.draw_on(executor)) return false;
  resize(picture.window);
  const auto& half = sky_.finest();
  each_row(executor, picture.window, [&](int y) {
    for (int x = picture.window.x0; x < picture.window.x1; ++x) {
      const bool own = picture.is_clear(x, y);
      const Texel drawn_on =
          own ? Texel{} : half.between(x - picture.window.x0, y - picture.window.y0);
      for (std::size_t i = 0; i < 3; ++i) {
        color_[i].view().at(x, y) = own ? picture.color[i].at(x, y) : drawn_on[i];
      }
    }
  });
  return true;
}

void Sky::make_even(const Frame& frame, const Rgb<double>& color, Executor& executor) {
  const Rect window = Picture(frame).window;
  resize(window);
  const double values[] = {color.r, color.g, color.b};
  each_row(executor, window, [&](int y) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::fill_n(color_[i].view().row(y), window.width(), static_cast<float>(values[i]));
    }
  });
}

void Sky::resize(const Rect& window) {
  for (Plane& plane : color_) {
    if (!plane || plane.view().window != window) plane = Plane(window);
  }
}

namespace {

/// A line through points, by least squares.
class Line {
 public:
  void add(double x, double y) {
    count_ += 1, x_ += x, y_ += y, xx_ += x * x, yy_ += y * y, xy_ += x * y;
  }
  double count() const { return count_; }
  double mean_x() const { return x_ / count_; }
  double mean_y() const { return y_ / count_; }
  struct Fit {
    double slope, explained;  ///< share of the variance of y
  };
  /// 0 and 0 for points with one x.
  Fit fit() const {
    constexpr double kLeastVariance = 1e-8;  // less comes from rounding alone
    const double variance = xx_ - x_ * x_ / std::max(count_, 1.0);
    if (!(variance > kLeastVariance * count_)) return {0, 0};
    const double covariance = xy_ - x_ * y_ / count_, whole = yy_ - y_ * y_ / count_;
    const double slope = covariance / variance;
    return {slope, whole > 0 ? std::min(covariance * slope / whole, 1.0) : 0};
  }

 private:
  double count_ = 0, x_ = 0, y_ = 0, xx_ = 0, yy_ = 0, xy_ = 0;
};

/// The visible sky, clear of objects, at some hundred rows and columns.
class SkySamples {
 public:
  SkySamples(const Frame& frame, const Pass& pass) : pass_(pass) {
    constexpr int kMost = 256;
    const Picture picture(frame);
    const Rect& window = picture.window;
    const int step_x = std::max(1, window.width() / kMost);
    const int step_y = std::max(1, window.height() / kMost);
    for (int y = window.y0; y < window.y1; y += step_y) {
      for (int x = window.x0; x < window.x1; x += step_x) {
        if (picture.is_clear(x, y)) add(picture, x, y);
      }
    }
  }

  /// The least squares of sky_change().
  SkyChange change() const {
    std::array<double, 3> with_elevation{}, with_sun{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [alone, by_alone] = of_elevation_[i].fit();
      const auto [both, by_both] = of_both_[i].fit();
      const bool glows = pass_.has_sun && both > 0 && by_both > by_alone;
      const double change = glows ? both * by_both : alone * by_alone;
      with_elevation[i] = std::clamp(change, -kMostSkyGain, kMostSkyFall);
      if (glows) with_sun[i] = std::min(with_elevation[i], kMostSkyGlow);
    }
    const auto [r, g, b] = with_elevation;
    const double least = std::min(std::max({r, g, b}), 0.0);
    return {{std::max(r, least), std::max(g, least), std::max(b, least)},
            {with_sun[0], with_sun[1], with_sun[2]}};
  }

  /// The mean over the hemisphere that shown_sky_radiance() gives.
  std::optional<Rgb<double>> radiance() const {
    if (count_ == 0) return {};
    const SkyChange with = change();
    const double elevations[] = {with.with_elevation.r, with.with_elevation.g,
                                 with.with_elevation.b};
    const double suns[] = {with.with_sun.r, with.with_sun.g, with.with_sun.b};
    std::array<double, 3> mean{};
    for (std::size_t i = 0; i < 3; ++i) {
      if (of_elevation_[i].count() == 0) continue;
      const double elevation = of_elevation_[i].mean_x();
      const double sun = of_both_[i].mean_x() - elevation;
      const double level = of_elevation_[i].mean_y() - elevations[i] * elevation - suns[i] * sun;
      mean[i] = of_elevation_[i].count() / count_ * mean_over_sky(level, elevations[i], suns[i]);
    }
    return Rgb<double>{mean[0], mean[1], mean[2]};
  }

 private:
  void add(const Picture& picture, int x, int y) {
    const glm::dvec3 view =
        glm::normalize(pass_.rays.ray_at(x - pass_.corner.x + 0.5, y - pass_.corner.y + 0.5));
    const double sine = glm::dot(pass_.up, view);
    if (!(sine > 0)) return;
    count_ += 1;
    const double elevation = clear_sky_by_elevation(sine);
    const double sun = clear_sky_by_sun(glm::dot(pass_.sun.direction, view));
    for (std::size_t i = 0; i < 3; ++i) {
      const double color = picture.color[i].at(x, y);
      if (!(color > 0 && color < HUGE_VAL)) continue;
      of_elevation_[i].add(elevation, std::log(color));
      of_both_[i].add(elevation + sun, std::log(color));
    }
  }

  /// Rings of equal shares of a level surface's light.
  double mean_over_sky(double level, double elevation, double sun) const {
    constexpr int kRings = 16, kAround = 32;
    const glm::dvec3& to_sun = pass_.sun.direction;
    double sum = 0;
    for (int i = 0; i < kRings; ++i) {
      const double square = (i + 0.5) / kRings;  // of the sine of the elevation
      const double sine = std::sqrt(square), cosine = std::sqrt(1 - square);
      for (int k = 0; k < kAround; ++k) {
        const double turn = 2 * std::numbers::pi * k / kAround;
        const glm::dvec3 direction =
            sine * pass_.up + cosine * std::cos(turn) * pass_.t + cosine * std::sin(turn) * pass_.b;
        sum += std::exp(level + elevation * clear_sky_by_elevation(sine) +
                        sun * clear_sky_by_sun(glm::dot(to_sun, direction)));
      }
    }
    return sum / (kRings * kAround);
  }

  const Pass& pass_;
  double count_ = 0;                            // of the samples above the horizon
  std::array<Line, 3> of_elevation_, of_both_;  // of those that shine in a color
};

}  // namespace

SkyChange sky_change(const Frame& frame, const Pass& pass) {
  return SkySamples(frame, pass).change();
}

std::optional<Rgb<double>> shown_sky_radiance(const Frame& frame, const Pass& pass) {
  return SkySamples(frame, pass).radiance();
}

bool shows_sky(const Frame& frame) {
  const Picture picture(frame);
  for (int y = picture.window.y0; y < picture.window.y1; ++y) {
    for (int x = picture.window.x0; x < picture.window.x1; ++x) {
      if (picture.is_sky(x, y)) return true;
    }
  }
  return false;
}

namespace {

/// The brightness of the surfaces that a picture shows: the mean of the roots of the colors in some
/// hundred rows and columns, squared, so that a few lamps do not count.
double ground_brightness(const Frame& frame) {
  constexpr int kMost = 256;
  const Picture picture(frame);
  const Rect& window = picture.window;
  const int step_x = std::max(1, window.width() / kMost);
  const int step_y = std::max(1, window.height() / kMost);
  double sum = 0;
  int count = 0;
  for (int y = window.y0; y < window.y1; y += step_y) {
    for (int x = window.x0; x < window.x1; x += step_x) {
      if (!(picture.depth.at(x, y) < 1e30f)) continue;
      double color = 0;
      for (const View<const float>& view : picture.color) color += view.at(x, y) / 3.0;
      if (!(color < HUGE_VAL)) continue;
      sum += std::sqrt(std::max(color, 0.0));
      ++count;
    }
  }
  const double root = count > 0 ? sum / count : 0;
  return root * root;
}

/// The mean radiance of a clear sky, as a share of the radiance of a white surface that faces its
/// sun: what the air scatters out of the sun's light on its way, half of it down by molecules and
/// .8 by haze, scattered once. `sine` is that of the sun's elevation. Optical depths: Bucholtz
/// 1995, "Rayleigh-scattering calculations for the terrestrial atmosphere", at 610, 550 and 465 nm,
/// and haze of .12 at 550 nm.
Rgb<double> clear_sky_share(double sine) {
  constexpr std::array<double, 3> kMolecules{0.064, 0.098, 0.194}, kHaze{0.105, 0.12, 0.149};
  constexpr double kDown = 0.5, kHazeDown = 0.8;
  constexpr double kLowest = 0.15;  // of the sine: along lower rays the air is no flat layer
  std::array<double, 3> share{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double depth = kMolecules[i] + kHaze[i];
    const double down = (kDown * kMolecules[i] + kHazeDown * kHaze[i]) / depth;
    share[i] = std::max(sine, 0.0) * std::expm1(depth / std::max(sine, kLowest)) * down;
  }
  return {share[0], share[1], share[2]};
}

}  // namespace

Rgb<double> guessed_sky(const Frame& frame, const Pass& pass) {
  constexpr double kOverGround = 2;  // an albedo of .5
  const double most = kOverGround * ground_brightness(frame);
  if (!pass.has_sun) return {most, most, most};
  const double sine = glm::dot(pass.up, pass.sun.direction);
  const Rgb<double> share = clear_sky_share(sine);
  const auto guess = [&](double sun, double of_sun) {
    const double least = std::max(of_sun * sun, most - std::max(sine, 0.0) * sun);
    return std::sqrt(most * std::min(least, most));
  };
  return {guess(pass.sun.color.r, share.r), guess(pass.sun.color.g, share.g),
          guess(pass.sun.color.b, share.b)};
}

}  // namespace limpid

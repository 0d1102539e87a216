#include "complete/scattered_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "complete/least_squares.h"
#include "complete/slab.h"
#include "optics/absorption.h"
#include "optics/fresnel.h"

namespace limpid {
namespace {

constexpr int kDegree = ScatteredLight::kDegree, kShapes = ScatteredLight::kShapes;
std::array<double, 3> channels(const Rgb<double>& c) { return {c.r, c.g, c.b}; }

constexpr int kCount = SlabDirections::kCount, kModes = 4;
/// In endless water, where all light fades with depth: less light than kDark, and layers optically
/// deeper than kDeepest, count as nothing. The rates of fading are kept apart: the beam's rate is
/// at least kApart times the slowest, the fastest is kFast times the beam's, and the one between is
/// at least kSlow of the beam's.
constexpr double kDark = 1e-6, kDeepest = 128, kApart = 1.3, kFast = 4, kSlow = 0.05;
/// For light from a floor: water of a smaller optical depth counts as having none; the rates at
/// which the light fades, over the rate of extinction; the cosines to the vertical of the fitted
/// views.
constexpr double kThinnest = 1e-4;
constexpr std::array kFloorFades{0.3, 1.2, 5.0, 0.6};
constexpr std::array kCosines{-0.95, -0.75, -0.5, -0.25, -0.08, 0.08, 0.25, 0.5, 0.75, 0.95};
/// The directions in the water of a view from the air.
constexpr int kFirstSeen = SlabDirections::kInside;

/// Azimuths at which light is fitted.
constexpr int kAzimuths = 6;
double azimuth_of(int a) { return a * std::numbers::pi / (kAzimuths - 1); }

/// Moments of the phase function without its peak, over its share. Legendre polynomials, fitted
/// relatively from 10 degrees on.
std::array<double, SlabWater::kMoments> moments_of(double anisotropy) {
  constexpr std::size_t kFitted = SlabWater::kMoments - 1;
  const double rest = 1 - narrow_share(anisotropy);
  LeastSquares<kFitted> fit;
  for (int degrees = 10; degrees <= 180; ++degrees) {
    const double angle = degrees * (std::numbers::pi / 180), x = std::cos(angle);
    const double phase = 4 * std::numbers::pi * henyey_greenstein(x, anisotropy);
    const double weight = std::sqrt(std::sin(angle) + 0.02) / phase;
    std::array<double, kFitted> row;
    double before = 1, value = x;
    for (std::size_t l = 1; l <= kFitted; ++l) {
      const double degree = static_cast<double>(l);
      row[l - 1] = weight * (2 * degree + 1) * value;
      const double next = ((2 * degree + 1) * x * value - degree * before) / (degree + 1);
      before = value, value = next;
    }
    fit.add(row, weight * (phase - rest));
  }
  std::array<double, SlabWater::kMoments> moments{1};
  const auto fitted = fit.solved();
  for (std::size_t l = 1; l <= kFitted; ++l) moments[l] = fitted[l - 1] / rest;
  return moments;
}

/// Fits one number per layer.
ScatteredLight::Power power_fit(const SlabLayers& layers, auto&& of) {
  LeastSquares<kDegree> fit;
  for (const SlabLight& layer : layers) {
    std::array<double, kDegree> row;
    double power = 1;
    for (double& entry : row) entry = power *= layer_variable(layer.depth);
    fit.add(row, of(layer));
  }
  return fit.solved();
}

/// Fits sums of shapes: of(layer, direction) by shape(k, direction).
template <std::size_t N>
class ShapesFit {
 public:
  void add(double depth, const std::array<double, N>& shapes, double value, double weight) {
    std::array<double, N * kDegree> row;
    for (std::size_t k = 0; k < N; ++k) {
      double power = weight * shapes[k];
      for (std::size_t i = 0; i < kDegree; ++i) {
        row[k * kDegree + i] = power *= layer_variable(depth);
      }
    }
    fit_.add(row, weight * value);
  }
  std::array<ScatteredLight::Power, N> solved() const {
    const auto all = fit_.solved();
    std::array<ScatteredLight::Power, N> powers;
    for (std::size_t k = 0; k < N; ++k) {
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(k * kDegree), kDegree,
                  powers[k].begin());
    }
    return powers;
  }

 private:
  LeastSquares<N * kDegree> fit_;
};

/// The water of one channel, under its surface.
struct ChannelWater {
  double beam, extinction, once;
  SlabWater slab;
  SlabDirections::Radiance reflects{};

  ChannelWater(const ScatteringWater& water, const SlabDirections& directions,
               const std::array<double, SlabWater::kMoments>& moments, double absorption,
               double scattering)
      : beam(std::clamp(water.beam, 0.02, 1.0)), slab{0, moments} {
    const double wide = scattering * (1 - narrow_share(water.anisotropy));
    extinction = absorption + wide;
    once = extinction > 0 ? scattering / extinction : 0;
    slab.albedo = extinction > 0 ? wide / extinction : 0;
    for (std::size_t i = 0; i < kCount && water.surface; ++i) {
      reflects[i] = fresnel_exact(directions.cosine[i], 1 / water.ior);
    }
  }
};

/// One channel: its layers in all modes, and the fits.
class Channel {
 public:
  Channel(const ScatteringWater& water, const SlabDirections& directions,
          const ChannelWater& channel)
      : directions_(directions),
        anisotropy_(water.anisotropy),
        beam_(channel.beam),
        extinction_(channel.extinction),
        once_(channel.once) {
    const SlabWater& slab = channel.slab;
    const SlabDirections::Radiance& reflects = channel.reflects;
    mode_count_ = water.anisotropy == 0 ? 1 : kModes;
    for (std::size_t mode = 0; mode < mode_count_; ++mode) {
      modes_[mode] = solve_slab(directions, slab, reflects, beam_, static_cast<int>(mode));
    }
    light_.back_at_once = directions.flux(reflects);
    light_.sky_at_once = 1 - light_.back_at_once;
    fit_even();
    fit_sun();
    put_bounds();
    if (water.inside && slab.albedo > 0) fit_inside(slab, reflects);
  }

  const ScatteredLight& light() const { return light_; }

 private:
  const SlabLayers& even_layers() const { return modes_[0]; }

  void fit_even() {
    const auto& layers = even_layers();
    light_.sun_below = power_fit(layers, [&](const SlabLight& l) { return l.sun_below; });
    light_.sky_below =
        power_fit(layers, [&](const SlabLight& l) { return l.sky_below - light_.sky_at_once; });
    light_.back =
        power_fit(layers, [&](const SlabLight& l) { return l.back - light_.back_at_once; });
    ShapesFit<2> sky, passing;
    for (const SlabLight& layer : layers) {
      for (std::size_t i = kFirstSeen; i < kCount; ++i) {
        const double cosine = directions_.cosine[i];
        sky.add(layer.depth, {1, cosine}, layer.sky[i], 1);
        passing.add(layer.depth, {1, cosine}, layer.passing[i] - std::exp(-layer.depth / cosine),
                    1);
      }
    }
    light_.sky = sky.solved();
    light_.passing = passing.solved();
  }

  /// Multiple scattering of sunlight in a direction, by layer.
  double sun_of(std::size_t layer, std::size_t direction, int a) const {
    double sum = modes_[0][layer].sun[direction];
    for (std::size_t m = 1; m < mode_count_; ++m) {
      sum += 2 * modes_[m][layer].sun[direction] * std::cos(double(m) * azimuth_of(a));
    }
    return sum;
  }

  /// Relative to all sunlight that comes up, single scattering included.
  void fit_sun() {
    ShapesFit<kShapes> fit;
    each_view([&](std::size_t i, int a) {
      const double cosine = directions_.cosine[i], turned = turned_of(i, a);
      const double once = once_ * std::numbers::pi * henyey_greenstein(turned, anisotropy_) *
                          beam_ / (beam_ + cosine);
      for (std::size_t k = 0; k < even_layers().size(); ++k) {
        const double depth = even_layers()[k].depth;
        const double met = 1 - std::exp(-depth / cosine - depth / beam_);
        const double share = sun_of(k, i, a) / met;
        fit.add(depth, shapes(cosine, turned), share, 1 / std::max(once + share, 1e-6));
      }
    });
    light_.sun = fit.solved();
  }

  /// Cosine of the angle between the sunlight and a view.
  double turned_of(std::size_t direction, int a) const {
    const double cosine = directions_.cosine[direction];
    const double level = std::sqrt((1 - cosine * cosine) * (1 - beam_ * beam_));
    return level * std::cos(azimuth_of(a)) - cosine * beam_;
  }

  /// What the fits say of a layer: its scattered light in one direction, and the light of the
  /// whitest bottom.
  struct Fitted {
    double sun, sky, bottom_sun, bottom_sky, bottom;  ///< bottom: in light of irradiance pi
  };
  Fitted fitted(double depth, std::size_t direction, int a) const {
    const double cosine = directions_.cosine[direction], x = layer_variable(depth);
    const std::array<double, 2> even{1, cosine};
    const double left = std::exp(-depth / cosine), fallen = std::exp(-depth / beam_);
    const double most = ScatteredLight::kMaxAlbedo;
    const double back = light_.back_at_once + layer_power(light_.back, x);
    const double through = most * (left + layer_power(light_.passing, even, x)) / (1 - most * back);
    return {
        (1 - left * fallen) * layer_power(light_.sun, shapes(cosine, turned_of(direction, a)), x),
        layer_power(light_.sky, even, x),
        through * (beam_ * fallen + layer_power(light_.sun_below, x)),
        through * (light_.sky_at_once + layer_power(light_.sky_below, x)), through};
  }

  /// Of the fits, at several depths from each layer to the next.
  void put_bounds() {
    constexpr int kParts = 4;
    constexpr double kEndless = 1e6;
    const auto& layers = even_layers();
    const std::size_t last = layers.size() - 1;
    for (std::size_t k = last + 1; k-- > 0;) {
      double sun_off = 0, sky_off = 0, bottom = 0;
      each_view([&](std::size_t i, int a) {
        const Fitted endless = fitted(kEndless, i, a);
        for (int part = 0; part < kParts; ++part) {
          const double depth = layers[k].depth * std::exp2(double(part) / kParts);
          const Fitted here = fitted(depth, i, a);
          light_.most_sun = std::max(light_.most_sun, here.sun);
          light_.slope_sun = std::max(light_.slope_sun, here.sun / depth);
          light_.most_sky = std::max(light_.most_sky, here.sky);
          light_.slope_sky = std::max(light_.slope_sky, here.sky / depth);
          light_.most_bottom_sun = std::max(light_.most_bottom_sun, here.bottom_sun);
          light_.most_bottom_sky = std::max(light_.most_bottom_sky, here.bottom_sky);
          bottom = std::max(bottom, here.bottom);
          sun_off =
              std::max(sun_off, std::abs(here.sun - endless.sun) + std::max(here.bottom_sun, 0.0));
          sky_off =
              std::max(sky_off, std::abs(here.sky - endless.sky) + std::max(here.bottom_sky, 0.0));
        }
      });
      const double deeper_sun = k < last ? light_.beyond_sun[k + 1] : 0;
      const double deeper_sky = k < last ? light_.beyond_sky[k + 1] : 0;
      light_.beyond_bottom[k] = std::max(k < last ? light_.beyond_bottom[k + 1] : 0, bottom);
      light_.beyond_sun[k] = std::max(deeper_sun, sun_off);
      light_.beyond_sky[k] = std::max(deeper_sky, sky_off);
    }
  }

  /// Calls visit(direction, azimuth) for the directions of views from the air.
  template <class Visit>
  void each_view(Visit&& visit) const {
    const int azimuths = mode_count_ > 1 ? kAzimuths : 1;
    for (std::size_t i = kFirstSeen; i < kCount; ++i) {
      for (int a = 0; a < azimuths; ++a) visit(i, a);
    }
  }

  std::array<double, kShapes> shapes(double cosine, double turned) const {
    if (anisotropy_ == 0) return {1, cosine, 0, 0};
    return {1, cosine, turned, henyey_greenstein(turned, anisotropy_ * anisotropy_)};
  }

  /// For views in the water.
  void fit_inside(const SlabWater& slab, const SlabDirections::Radiance& reflects) {
    constexpr int kSides = 8;  // cosines to each side of level
    constexpr std::size_t kFades = ScatteredLight::kFades, kInside = ScatteredLight::kInside;
    std::array<InsideLights, kModes> modes;
    for (std::size_t mode = 0; mode < mode_count_; ++mode) {
      modes[mode] = solve_inside(directions_, slab, reflects, beam_, static_cast<int>(mode));
    }
    const InsideLights& even = modes[0];
    std::size_t count = 1;  // of layers with light
    double slowest = 0;     // rate of fading far down
    for (; count < even.size() && even[count].depth <= kDeepest; ++count) {
      const double before = directions_.flux(even[count - 1].sky_down);
      const double now = directions_.flux(even[count].sky_down);
      if (!(now > kDark)) break;
      slowest = std::max(std::log(before / now), 0.0) / (even[count].depth - even[count - 1].depth);
    }
    const double beam = std::max(1 / beam_, kApart * slowest);
    const double between = std::sqrt(std::max(slowest, kSlow * beam) * beam);
    const std::array<double, kFades> rates{slowest, between, beam, kFast * beam};
    LeastSquares<kInside * kFades> of_sun, of_sky;
    const auto add = [&](auto& fit, double depth, const std::array<double, kInside>& by,
                         double value) {
      const double weight = 1 / std::max(value, kDark);
      std::array<double, kInside * kFades> row;
      for (std::size_t f = 0; f < kFades; ++f) {
        const double left = weight * std::exp(-rates[f] * depth);
        for (std::size_t n = 0; n < kInside; ++n) row[f * kInside + n] = left * by[n];
      }
      fit.add(row, weight * value);
    };
    const double level_beam = std::sqrt(1 - beam_ * beam_);
    for (int i = 0; i < 2 * kSides; ++i) {
      const double cosine = (i + 0.5) / kSides - 1;  // of light with the upwards vertical
      const auto mode = [&](int m) { return SlabSource(directions_, slab, m, cosine); };
      const std::array<SlabSource, kModes> sources{mode(0), mode(1), mode(2), mode(3)};
      for (std::size_t k = 0; k < count; ++k) {
        const InsideLight& light = even[k];
        add(of_sky, light.depth, inside_sky_shapes(cosine),
            sources[0].of(light.sky_up, light.sky_down));
        std::array<double, kModes> parts{};
        for (std::size_t m = 0; m < mode_count_; ++m) {
          parts[m] = sources[m].of(modes[m][k].sun_up, modes[m][k].sun_down);
        }
        for (int a = 0; a < (mode_count_ > 1 ? kAzimuths : 1); ++a) {
          double sum = parts[0];
          for (std::size_t m = 1; m < mode_count_; ++m) {
            sum += 2 * parts[m] * std::cos(double(m) * azimuth_of(a));
          }
          const double turned =
              std::sqrt(1 - cosine * cosine) * level_beam * std::cos(azimuth_of(a)) -
              cosine * beam_;
          add(of_sun, light.depth,
              inside_sun_shapes(cosine, turned, anisotropy_ * anisotropy_, mode_count_ > 1), sum);
        }
      }
    }
    const auto sun = of_sun.solved(), sky = of_sky.solved();
    for (std::size_t f = 0; f < kFades; ++f) {
      light_.fades[f] = extinction_ * rates[f];
      for (std::size_t n = 0; n < kInside; ++n) {
        light_.inside_sun[f][n] = extinction_ * sun[f * kInside + n];
        light_.inside_sky[f][n] = extinction_ * sky[f * kInside + n];
      }
    }
  }

  const SlabDirections& directions_;
  double anisotropy_, beam_, extinction_, once_;
  std::array<SlabLayers, kModes> modes_;
  std::size_t mode_count_;
  ScatteredLight light_;
};

/// Fits the difference that a floor makes to the light in endless water.
void put_floor(const SlabDirections& directions, const ChannelWater& water, const WaterFloor& floor,
               double albedo, double anisotropy, ScatteredLight& light) {
  constexpr std::size_t kFloored = ScatteredLight::kFloored, kInside = ScatteredLight::kInside;
  constexpr double kSteady = 1e-7;
  light.floor_sun = light.floor_sky = {};
  light.floor = 0;
  const SlabFloor below{water.extinction * floor.depth, albedo, floor.share};
  const bool felt = below.depth > kThinnest && below.depth < kDeepest && below.share > 0;
  if (!felt || !(water.slab.albedo > 0)) return;
  const std::size_t mode_count = anisotropy == 0 ? 1 : kModes;
  std::array<FlooredLights, kModes> with, without;
  for (std::size_t m = 0; m < mode_count; ++m) {
    const int mode = static_cast<int>(m);
    const auto solve = [&](double share) {
      return solve_over_floor(directions, water.slab, water.reflects, water.beam,
                              {below.depth, below.albedo, share}, mode);
    };
    with[m] = solve(below.share), without[m] = solve(0);
  }
  LeastSquares<kInside * kFloored> of_sun(kSteady), of_sky(kSteady);
  const double level_beam = std::sqrt(1 - water.beam * water.beam);
  for (const double cosine : kCosines) {
    std::array<std::optional<SlabSource>, kModes> sources;
    for (std::size_t m = 0; m < mode_count; ++m) {
      sources[m].emplace(directions, water.slab, static_cast<int>(m), cosine);
    }
    for (std::size_t k = 0; k < FlooredLights::kCount; ++k) {
      const InsideLight &lit = with[0].lights[k], &before = without[0].lights[k];
      const auto add = [&](auto& fit, const std::array<double, kInside>& shapes, double value,
                           double change) {
        const double weight = 1 / std::max(value, kDark);
        std::array<double, kInside * kFloored> row;
        for (std::size_t f = 0; f < kFloored; ++f) {
          const double distance = f < ScatteredLight::kRising ? below.depth - lit.depth : lit.depth;
          for (std::size_t n = 0; n < kInside; ++n) {
            row[f * kInside + n] = weight * std::exp(-kFloorFades[f] * distance) * shapes[n];
          }
        }
        fit.add(row, weight * change);
      };
      const double sky = sources[0]->of(lit.sky_up, lit.sky_down);
      add(of_sky, inside_sky_shapes(cosine), sky,
          sky - sources[0]->of(before.sky_up, before.sky_down));
      std::array<double, kModes> values{}, changes{};
      for (std::size_t m = 0; m < mode_count; ++m) {
        const InsideLight &now = with[m].lights[k], &then = without[m].lights[k];
        values[m] = sources[m]->of(now.sun_up, now.sun_down);
        changes[m] = values[m] - sources[m]->of(then.sun_up, then.sun_down);
      }
      for (int a = 0; a < (mode_count > 1 ? kAzimuths : 1); ++a) {
        double value = values[0], change = changes[0];
        for (std::size_t m = 1; m < mode_count; ++m) {
          const double wave = 2 * std::cos(double(m) * azimuth_of(a));
          value += wave * values[m], change += wave * changes[m];
        }
        const double turned =
            std::sqrt(1 - cosine * cosine) * level_beam * std::cos(azimuth_of(a)) -
            cosine * water.beam;
        add(of_sun, inside_sun_shapes(cosine, turned, anisotropy * anisotropy, mode_count > 1),
            value, change);
      }
    }
  }
  const auto sun = of_sun.solved(), sky = of_sky.solved();
  light.floor = floor.depth;
  for (std::size_t f = 0; f < kFloored; ++f) {
    light.floor_fades[f] = water.extinction * kFloorFades[f];
    for (std::size_t n = 0; n < kInside; ++n) {
      light.floor_sun[f][n] = water.extinction * sun[f * kInside + n];
      light.floor_sky[f][n] = water.extinction * sky[f * kInside + n];
    }
  }
}

}  // namespace

const ScatteredLights& ScatteredLightMaker::make(const ScatteringWater& water,
                                                 const WaterFloor& floor) {
  const bool same = made_ && water == water_;
  if (same && floor == floor_) return light_;
  const SlabDirections directions(water.ior);
  const auto moments = moments_of(water.anisotropy);
  const std::array<double, 3> absorption = channels(water.absorption),
                              scattering = channels(water.scattering),
                              albedo = channels(floor.albedo);
  for (std::size_t i = 0; i < 3; ++i) {
    const ChannelWater channel(water, directions, moments, absorption[i], scattering[i]);
    if (!same) light_[i] = Channel(water, directions, channel).light();
    if (water.inside) put_floor(directions, channel, floor, albedo[i], water.anisotropy, light_[i]);
  }
  water_ = water, floor_ = floor;
  made_ = true;
  return light_;
}

}  // namespace limpid

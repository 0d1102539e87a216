#include "complete/slab.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace limpid {
namespace {

constexpr int kCount = SlabDirections::kCount, kMoments = SlabWater::kMoments;
constexpr double kThin = 1.0 / 8192, kEndless = 8192;  ///< optical depths
using Radiance = SlabDirections::Radiance;
using Matrix = std::array<Radiance, kCount>;  ///< rows: outgoing light; columns: incoming light

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix product{};
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t k = 0; k < kCount; ++k) {
      for (std::size_t j = 0; j < kCount; ++j) product[i][j] += a[i][k] * b[k][j];
    }
  }
  return product;
}

Radiance operator*(const Matrix& a, const Radiance& b) {
  Radiance product{};
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t k = 0; k < kCount; ++k) product[i] += a[i][k] * b[k];
  }
  return product;
}

Radiance operator*(double a, Radiance b) {
  for (double& value : b) value *= a;
  return b;
}

Radiance each(const Radiance& a, Radiance b) {
  for (std::size_t i = 0; i < kCount; ++i) b[i] *= a[i];
  return b;
}

Radiance operator+(Radiance a, const Radiance& b) {
  for (std::size_t i = 0; i < kCount; ++i) a[i] += b[i];
  return a;
}

Matrix operator*(double a, Matrix b) {
  for (Radiance& row : b) row = a * row;
  return b;
}

Matrix operator+(Matrix a, const Matrix& b) {
  for (std::size_t i = 0; i < kCount; ++i) a[i] = a[i] + b[i];
  return a;
}

/// 1 / (1 - a): the sum over all reflections to and fro. By Gauss and Jordan; each reflection loses
/// light, so the largest entries stay on the diagonal.
Matrix to_and_fro(const Matrix& a) {
  Matrix left, right{};
  for (std::size_t i = 0; i < kCount; ++i) {
    left[i] = -1.0 * a[i];
    left[i][i] += 1;
    right[i][i] = 1;
  }
  for (std::size_t c = 0; c < kCount; ++c) {
    const double scale = 1 / left[c][c];
    left[c] = scale * left[c], right[c] = scale * right[c];
    for (std::size_t r = 0; r < kCount; ++r) {
      if (r == c) continue;
      const double share = -left[r][c];
      left[r] = left[r] + share * left[c], right[r] = right[r] + share * right[c];
    }
  }
  return right;
}

using Values = std::array<double, kMoments>;

/// Associated Legendre functions of one order at x, times sqrt((l - m)! / (l + m)!).
Values legendre(int order, double x) {
  const std::size_t m = static_cast<std::size_t>(order);
  Values values{};
  double first = 1;
  for (int i = 1; i <= order; ++i) first *= std::sqrt((1 - x * x) * (2 * i - 1) / (2 * i));
  values[m] = first;
  if (m + 1 < kMoments) values[m + 1] = x * std::sqrt(2.0 * order + 1) * first;
  for (std::size_t l = m + 2; l < kMoments; ++l) {
    const double degree = static_cast<double>(l), square = double(order) * order;
    values[l] = ((2 * degree - 1) * x * values[l - 1] -
                 std::sqrt((degree - 1) * (degree - 1) - square) * values[l - 2]) /
                std::sqrt(degree * degree - square);
  }
  return values;
}

/// The phase function's mode between two directions: onwards, or, `turned`, from down to up.
double mode_between(const SlabWater& water, int mode, const Values& a, const Values& b,
                    bool turned) {
  double sum = 0;
  for (int l = mode; l < kMoments; ++l) {
    const std::size_t i = static_cast<std::size_t>(l);
    const double part = (2 * l + 1) * water.moments[i] * a[i] * b[i];
    sum += turned && (l - mode) % 2 != 0 ? -part : part;
  }
  return sum;
}

/// A layer without a surface: its response to incoming light, and to the beam.
struct Layer {
  double depth;
  Matrix back, through;  ///< of light incoming from either side
  Radiance up, down;     ///< of the beam, outgoing at the top and the bottom

  /// Thin enough for single scattering.
  Layer(const SlabDirections& directions, const SlabWater& water, double beam, int mode,
        double thin)
      : depth(thin) {
    const Values from_beam = legendre(mode, beam);
    std::array<Values, kCount> of;
    for (std::size_t i = 0; i < kCount; ++i) of[i] = legendre(mode, directions.cosine[i]);
    for (std::size_t i = 0; i < kCount; ++i) {
      const double met = thin / directions.cosine[i] * water.albedo / 2;
      for (std::size_t j = 0; j < kCount; ++j) {
        const double share = met * directions.weight[j];
        back[i][j] = share * mode_between(water, mode, of[i], of[j], true);
        through[i][j] = share * mode_between(water, mode, of[i], of[j], false);
      }
      // Not exp(-...): the scattered light is computed to first order, and without absorption no
      // light may be gained, because each doubling would gain it again.
      through[i][i] += 1 - thin / directions.cosine[i];
      up[i] = met / 2 * mode_between(water, mode, of[i], from_beam, true);
      down[i] = met / 2 * mode_between(water, mode, of[i], from_beam, false);
    }
  }

  /// Adds a layer of the same water below. The same water answers light from either side alike.
  void put_on(const Layer& lower, double beam) {
    const double left = std::exp(-depth / beam);  // of the beam, for the lower layer
    const Matrix between = to_and_fro(lower.back * back);
    const Radiance rising = between * (left * lower.up + lower.back * down);
    const Radiance sinking = down + back * rising;
    up = up + through * rising;
    down = left * lower.down + lower.through * sinking;
    const Matrix onwards =
        lower.through * (&lower == this ? between : to_and_fro(back * lower.back)) * through;
    back = back + through * between * (lower.back * through);
    through = onwards;
    depth += lower.depth;
  }
  void make_twice_as_deep(double beam) { put_on(*this, beam); }
};

/// The response of all water and floor below some depth to light from above, and to the beam.
struct Lower {
  Matrix back;
  Radiance up;
};

SlabLight light_of(const Layer& layer, const SlabDirections& directions, const SlabWater& water,
                   const Radiance& reflects, double beam, int mode) {
  Matrix under = layer.back;  // light that the surface reflects down and the layer up again
  for (Radiance& row : under) row = each(reflects, row);
  const Matrix between = to_and_fro(under);
  SlabLight light;
  light.depth = layer.depth;
  light.sun = between * layer.up;
  light.sun_below = directions.flux(layer.down + layer.through * each(reflects, light.sun));
  const Values from_beam = legendre(mode, beam);
  for (std::size_t i = 0; i < kCount; ++i) {
    const double cosine = directions.cosine[i];
    const double first =
        mode_between(water, mode, legendre(mode, cosine), from_beam, true) * water.albedo / 4;
    const double met = 1 - std::exp(-layer.depth / cosine - layer.depth / beam);
    light.sun[i] -= first * met * beam / (beam + cosine);
  }
  if (mode > 0) return light;
  Radiance even;
  even.fill(1);
  light.passing = between * (layer.through * even);
  light.back = directions.flux(layer.back * even + layer.through * each(reflects, light.passing));
  // From the sky: transmitted light fills, at its own radiance, the cone in the water.
  Radiance entering;
  for (std::size_t i = 0; i < kCount; ++i) entering[i] = 1 - reflects[i];
  light.sky = between * (layer.back * entering);
  light.sky_below = directions.flux(layer.through * (entering + each(reflects, light.sky)));
  return light;
}

/// Gauss-Legendre nodes of an interval.
void put_nodes(double from, double to, int count, double* nodes, double* weights) {
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 0;
    for (int round = 0; round < 20; ++round) {
      double value = x, before = 1;
      for (int l = 1; l < count; ++l) {
        const double next = ((2 * l + 1) * x * value - l * before) / (l + 1);
        before = value, value = next;
      }
      slope = count * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    nodes[i] = 0.5 * (from + to) + 0.5 * (to - from) * x;
    weights[i] = (to - from) / ((1 - x * x) * slope * slope);
  }
}

}  // namespace

SlabDirections::SlabDirections(double ior) {
  const double critical = std::sqrt(1 - 1 / (ior * ior));
  put_nodes(0, critical, kInside, cosine.data(), weight.data());
  put_nodes(critical, 1, kInside, cosine.data() + kInside, weight.data() + kInside);
}

double SlabDirections::flux(const Radiance& radiance) const {
  double sum = 0;
  for (std::size_t i = 0; i < kCount; ++i) sum += 2 * weight[i] * cosine[i] * radiance[i];
  return sum;
}

SlabLayers solve_slab(const SlabDirections& directions, const SlabWater& water,
                      const SlabDirections::Radiance& reflects, double beam, int mode) {
  Layer layer(directions, water, beam, mode, kThin);
  while (layer.depth < SlabLight::kFirst) layer.make_twice_as_deep(beam);
  SlabLayers layers;
  for (SlabLight& light : layers) {
    light = light_of(layer, directions, water, reflects, beam, mode);
    layer.make_twice_as_deep(beam);
  }
  return layers;
}

namespace {

/// Light at the lower end of a layer under the surface, over `lower`.
InsideLight light_at(const Layer& layer, const Lower& lower, const Radiance& reflects,
                     const Radiance& entering, double beam) {
  Matrix under = layer.back;
  for (Radiance& row : under) row = each(reflects, row);
  const Matrix between = to_and_fro(under);
  // Light at the top, upwards, for light `up` from below and light sent up and transmitted above.
  const auto top = [&](const Radiance& sent, const Radiance& up) {
    return between * (sent + layer.through * up);
  };
  // Light from below that comes down again, for each of its directions.
  Matrix again;
  for (std::size_t j = 0; j < kCount; ++j) {
    Radiance one{};
    one[j] = 1;
    const Radiance down = layer.back * one + layer.through * each(reflects, top(Radiance{}, one));
    for (std::size_t i = 0; i < kCount; ++i) again[i][j] = down[i];
  }
  const Matrix to_below = to_and_fro(lower.back * again);
  const auto solve = [&](const Radiance& sent, const Radiance& sinks, const Radiance& rises,
                         Radiance& up, Radiance& down) {
    const Radiance first = sinks + layer.through * each(reflects, top(sent, Radiance{}));
    up = to_below * (lower.back * first + rises);
    down = first + again * up;
  };
  InsideLight light;
  light.depth = layer.depth;
  solve(layer.up, layer.down, std::exp(-layer.depth / beam) * lower.up, light.sun_up,
        light.sun_down);
  solve(layer.back * entering, layer.through * entering, Radiance{}, light.sky_up, light.sky_down);
  return light;
}

/// From the sky: transmitted light fills, at its own radiance, the cone in the water.
Radiance light_entering(const Radiance& reflects, int mode) {
  Radiance entering{};
  for (std::size_t i = 0; i < kCount && mode == 0; ++i) entering[i] = 1 - reflects[i];
  return entering;
}

Lower endless_water(Layer layer, double beam) {
  while (layer.depth < kEndless) layer.make_twice_as_deep(beam);
  return {layer.back, layer.up};
}

/// A layer over a floor.
Lower over_floor(const Layer& layer, const SlabDirections& directions, const SlabFloor& floor,
                 const Lower& endless, double beam, int mode) {
  const double albedo = mode > 0 ? 0 : floor.albedo;  // Lambert's light is even
  Matrix bounces;                                     // light down to light up
  for (Radiance& row : bounces) {
    for (std::size_t j = 0; j < kCount; ++j) {
      row[j] = albedo * 2 * directions.weight[j] * directions.cosine[j];
    }
  }
  Radiance lit;
  lit.fill(albedo * beam);
  const Matrix below = floor.share * bounces + (1 - floor.share) * endless.back;
  const Radiance sent = floor.share * lit + (1 - floor.share) * endless.up;
  const Matrix reaching = layer.through * to_and_fro(below * layer.back);
  const double left = std::exp(-layer.depth / beam);
  return {layer.back + reaching * (below * layer.through),
          layer.up + reaching * (below * layer.down + left * sent)};
}

}  // namespace

InsideLights solve_inside(const SlabDirections& directions, const SlabWater& water,
                          const SlabDirections::Radiance& reflects, double beam, int mode) {
  Layer layer(directions, water, beam, mode, kThin);
  const Lower endless = endless_water(layer, beam);
  while (layer.depth < SlabLight::kFirst) layer.make_twice_as_deep(beam);
  const Radiance entering = light_entering(reflects, mode);
  InsideLights lights;
  for (InsideLight& light : lights) {
    light = light_at(layer, endless, reflects, entering, beam);
    layer.make_twice_as_deep(beam);
  }
  return lights;
}

FlooredLights solve_over_floor(const SlabDirections& directions, const SlabWater& water,
                               const SlabDirections::Radiance& reflects, double beam,
                               const SlabFloor& floor, int mode) {
  constexpr std::size_t kHalvings = FlooredLights::kHalvings;
  const Lower endless = endless_water(Layer(directions, water, beam, mode, kThin), beam);
  const Radiance entering = light_entering(reflects, mode);
  double thin = floor.depth;
  const double least = std::ldexp(floor.depth, -static_cast<int>(kHalvings));
  while (thin > std::min(kThin, least)) thin /= 2;
  std::vector<Layer> parts;  // of the floor's depth: a half, a quarter ...
  Layer layer(directions, water, beam, mode, thin);
  while (layer.depth < 0.75 * floor.depth) {
    parts.insert(parts.begin(), layer);
    layer.make_twice_as_deep(beam);
  }
  FlooredLights floored;
  std::size_t count = 0;
  const auto add = [&](const Layer& above, const Layer& below) {
    floored.lights[count++] = light_at(
        above, over_floor(below, directions, floor, endless, beam, mode), reflects, entering, beam);
  };
  Layer deep = parts[0];
  add(deep, deep);
  for (std::size_t i = 1; i < kHalvings; ++i) {
    deep.put_on(parts[i], beam);
    add(parts[i], deep);
    add(deep, parts[i]);
  }
  return floored;
}

SlabSource::SlabSource(const SlabDirections& directions, const SlabWater& water, int mode,
                       double cosine) {
  const Values on = legendre(mode, std::abs(cosine));
  for (std::size_t i = 0; i < kCount; ++i) {
    const Values from = legendre(mode, directions.cosine[i]);
    const double share = directions.weight[i] * water.albedo / 2;
    up_[i] = share * mode_between(water, mode, on, from, cosine < 0);
    down_[i] = share * mode_between(water, mode, on, from, cosine > 0);
  }
}

double SlabSource::of(const Radiance& up, const Radiance& down) const {
  double sum = 0;
  for (std::size_t i = 0; i < kCount; ++i) sum += up_[i] * up[i] + down_[i] * down[i];
  return sum;
}

}  // namespace limpid

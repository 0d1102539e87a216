#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "op/bottom_layer.h"
#include "ops/caustics_kernel.h"

namespace limpid {
namespace {

using P = Caustics::Params;

constexpr std::string_view kSunlight[] = {"straight", "refracted"};

constexpr Field<P> kFields[] = {
    real<&P::strength>("strength", "", {0, 10},
                       "How much waves focus sunlight: 0 not at all, 1 physical."),
    real<&P::sun_share>("sun_share", "", {0, 1},
                        "Part of the bottom's light that is sunlight, if no sky is known."),
    choice<&P::sunlight, kSunlight>("sunlight",
                                    "Sunlight in the water, on slopes and in shadows: straight "
                                    "as in the dry picture, or refracted, with the planes "
                                    "sun_color or shadow; shadows need shadow."),
};

}  // namespace

std::span<const Field<P>> Caustics::fields() { return kFields; }

std::string_view Kernel<Caustics>::prefer(P& params, const AtHand& has) {
  if (params.sunlight == Sunlight::kStraight) return "";
  const bool known = has.planes.covers(kSunColorPlanes);
  if (has.planes.has(PlaneId::kShadow))
    return known ? "" : "no sun_color, the strength of sunlight is estimated";
  if (known) return "shadows on the bottom stay unrefracted";
  params.sunlight = Sunlight::kStraight;
  return "sunlight on the bottom stays unrefracted";
}

bool Kernel<Caustics>::knows_entries(const P& params, const Pass& c, PlaneSet planes) {
  return params.sunlight == Sunlight::kRefracted && glm::dot(c.sun.direction, c.up) > 1e-3 &&
         planes.covers(PlaneSet{PlaneId::kShadow, PlaneId::kSurfaceShadow});
}

Kernel<Caustics>::Light Kernel<Caustics>::light_of(const P& params, const Pass& c) {
  const glm::dvec3& to_sun = c.sun.direction;
  Light light{};
  light.rise = std::max(glm::dot(to_sun, c.up), 0.0);
  light.sine = std::sqrt(std::max(1 - light.rise * light.rise, 0.0));
  light.level = {glm::dot(to_sun, c.map_x), glm::dot(to_sun, c.map_y)};
  light.known = c.planes.covers(kSunColorPlanes);
  const bool refracted = params.sunlight == Sunlight::kRefracted;
  light.estimated = refracted && !light.known && c.planes.has(PlaneId::kShadow);
  light.bends = refracted && (light.known || light.estimated) && light.rise > 1e-3;
  light.moves = light.bends && c.planes.has(PlaneId::kShadow);
  light.entries = light.bends && knows_entries(params, c, c.planes);
  if (light.known && c.caustics) {
    for (std::size_t i = 0; i < 3; ++i) {
      light.around[i] = c.caustics->sun_over_rest[i] / (1 + c.caustics->sun_over_rest[i]);
    }
  }
  const Rgb<double>& color = c.sun.color;
  light.sun = {light.rise * color.r, light.rise * color.g, light.rise * color.b};
  light.ambient = {c.sky.r, c.sky.g, c.sky.b};
  if (!c.has_sky) {
    light.sun.fill(params.sun_share);
    light.ambient.fill(1 - params.sun_share);
  }
  if (light.estimated && c.caustics) {
    light.sun = c.caustics->sun_over_rest;
    light.ambient.fill(1);
  }
  return light;
}

std::array<double, 3> Kernel<Caustics>::sun_over_sky(const P& params, const Pass& c) {
  constexpr double kMost = 100;  // where the sky is almost black
  Pass unlit = c;
  unlit.caustics = nullptr;
  const Light light = light_of(params, unlit);
  std::array<double, 3> over{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (light.sun[i] > 0)
      over[i] = std::min(light.sun[i] / std::max(light.ambient[i], 1e-30), kMost);
  }
  return over;
}

/// The fog passes on a share of the light from below. The reflection of the bottom has the same
/// caustics in its bound. Of hidden bottom, and of bottom that is filled in, the fog learns its dry
/// sunlight here.
double Kernel<Caustics>::bound(const P& params, const Pass& c, const Ranges& ranges) {
  if (c.eye_above < 0 && c.planes.covers(kReflectionPlanes)) return HUGE_VAL;
  const bool filled = c.bottom_layer && c.bottom_layer->lit;
  const bool hidden = light_of(params, c).entries && (filled || SeenPlanes::of(c).below);
  return displaced(params, ranges) + (hidden ? ranges.detail : 0);
}

/// Caustics looked up at another place, or not at all.
double Kernel<Caustics>::displaced(const P&, const Ranges& ranges) {
  return bound_product(ranges.transmittance, ranges.focused);
}

/// The table bounds how much brighter or darker the sun's share may become; where the water bends
/// sunlight, all of it may vanish, or as much appear as slopes may gain.
void Kernel<Caustics>::propagate_ranges(const P& params, const Pass& c, Ranges& ranges) {
  ranges.focused = 0;
  const Light light = light_of(params, c);
  const double gain = c.caustics ? params.strength * (c.caustics->most - 1) : HUGE_VAL;
  const double loss = c.caustics ? params.strength * (1 - std::max(c.caustics->least, 0.0)) : 1;
  // Straight light counts as lighting the bottom behind an object.
  const double lit = SeenPlanes::of(c).below ? 1 : ranges.shadow.max;
  double change = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double share = 1;
    if (!light.known && !light.estimated) {
      const double direct = bound_product(lit, light.sun[i]);
      share = direct / std::max(direct + light.ambient[i], 1e-30);
    }
    change = std::max(change, bound_product(share, std::max(gain, loss)));
    if (!light.bends) continue;
    // Focused light lies between 1 - loss, which may be below 0, and 1 + gain.
    const double below_none = bound_product(kMostTilt, std::max(loss - 1, 0.0));
    change = std::max({change, bound_product(kMostTilt, 1 + gain) - 1, 1 + below_none});
    // Hidden bottom may get its straight light through land.
    const bool all_lit =
        ranges.shadow.min >= 1 && ranges.shadow_of_water.min >= 1 && !SeenPlanes::of(c).below;
    if (!light.moves || all_lit) continue;
    const double most = c.caustics ? std::max(c.caustics->sun_over_rest[i], 1.0) : HUGE_VAL;
    change = std::max(
        {change, bound_product(kMostTilt * most, 1 + gain), 1 + bound_product(most, below_none)});
  }
  change *= 1.0001;
  ranges.focused = bound_product(change, ranges.brightest());
  for (Range& color : ranges.color) {
    const double more = bound_product(change, std::max(std::abs(color.min), std::abs(color.max)));
    color = {color.min - more, color.max + more};
  }
  ranges.light = std::max(ranges.light, ranges.brightest());
}

}  // namespace limpid

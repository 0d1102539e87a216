#pragma once
#include <array>

#include <glm/vec3.hpp>

#include "core/water_view.h"
#include "optics/absorption.h"
#include "optics/scattered_light.h"
#include "optics/scattering.h"

/// @file
/// Light on its path through the water, as it reaches a viewer in the water.

namespace limpid {

/// Water, and the light in it, as shared by all pixels of a frame (ops/depth_fog.h has the
/// formulas).
struct WaterMedium {
  Rgb<double> rate;      ///< a + b
  Rgb<double> down;      ///< K / cos_sun: attenuation of sunlight per unit of depth
  Rgb<double> ambient;   ///< b ambient
  Rgb<double> sun;       ///< b E'
  glm::dvec3 to_sun;     ///< unit, in the water
  double bottom, water;  ///< crossing, of the bottom's light and of the sun's in-scatter
  bool glows, sunlit;    ///< whether there is in-scatter of ambient light, and of sunlight
  /// Multiple scattering, for red, green, blue; or null.
  const ScatteredLight* multiple;
  Rgb<double> beam, sky;         ///< E' / pi, and the sky's radiance in the water
  double cosine;                 ///< of the angle between the beam and the vertical
  Rgb<double> dry_sun, dry_sky;  ///< light of a white level floor that `transmitted` has already
  double per_bottom;             ///< 1 / bottom; 0 where no light enters
  double anisotropy, square;     ///< g of the phase function, and its square
  bool scatters, turns;          ///< whether light is scattered, and unevenly
  bool inside;                   ///< whether views may begin in the water

  static std::array<double, 3> channels(const Rgb<double>& c) { return {c.r, c.g, c.b}; }
  std::array<double, 3> rates() const { return channels(rate); }
  std::array<double, 3> beams() const { return channels(beam); }
  std::array<double, 3> skies() const { return channels(sky); }
  std::array<double, 3> dry_suns() const { return channels(dry_sun); }
  std::array<double, 3> dry_skies() const { return channels(dry_sky); }
};

/// The numbers of a medium that all paths through it need.
template <class F>
struct MediumNumbers {
  Rgb<F> rate, down, ambient, sun;
  Vec3<F> to_sun;

  LIMPID_INLINE explicit MediumNumbers(const WaterMedium& m)
      : rate(of(m.rate, "depth_fog.rate")),
        down(of(m.down, "depth_fog.down")),
        ambient(of(m.ambient, "depth_fog.ambient_light")),
        sun(of(m.sun, "depth_fog.sun_light")),
        to_sun(vec3_of<F>(m.to_sun, "depth_fog.to_sun")) {}

 private:
  static LIMPID_INLINE Rgb<F> of(const Rgb<double>& c, const char* name) {
    return {given<F>(c.r, name, 0), given<F>(c.g, name, 1), given<F>(c.b, name, 2)};
  }
};

/// In-scatter of the ambient light along a path; `left`: the path's transmittance.
template <class F>
LIMPID_INLINE Rgb<F> ambient_in_scatter(const MediumNumbers<F>& m, F length, const Rgb<F>& left) {
  return m.ambient * Rgb<F>{column_light(m.rate.r, length, left.r),
                            column_light(m.rate.g, length, left.g),
                            column_light(m.rate.b, length, left.b)};
}

/// The light of one channel that reaches a viewer besides single-scattered sunlight.
template <class F>
struct MultipleLight {
  F sun;     ///< multiple-scattered sunlight
  F sky;     ///< scattered skylight, and light that the surface has reflected down
  F bottom;  ///< unscattered light from the bottom, less what its light in air has given already
};

/// The albedo of a point of the bottom over the albedo around it, of one channel: from the point's
/// `color` in air, and from the light on a level floor there, of which sunlight has the share
/// `lit`. `known`: 0 ... 1; at 0 the point counts as the bottom around.
template <class F>
LIMPID_INLINE F albedo_detail(const WaterMedium& m, std::size_t channel, F color, F lit, F around,
                              F known) {
  constexpr double kDimmest = 0.1;  // below this share of the full light, the color tells less
  const int place = static_cast<int>(channel);
  const F sun = given<F>(m.dry_suns()[channel], "depth_fog.dry_sun", place);
  const F sky = given<F>(m.dry_skies()[channel], "depth_fog.dry_sky", place);
  const F light = lit * sun + sky, full = max(sun + sky, F(1e-30));
  const F per_bottom = given<F>(m.per_bottom, "depth_fog.per_bottom");
  const F own =
      min(max(color, F(0)) / max(light * per_bottom, F(1e-30)), F(ScatteredLight::kMaxAlbedo));
  // Light that is not known, as of walls around, is as much as a dim sky's in the shade.
  const F sure = known * saturate(light / (F(kDimmest) * full));
  return F(1) + sure * (own / max(around, F(1e-3)) - F(1));
}

/// The bottom at the end of a path, as the bottom of a level layer.
template <class F>
struct LitBottom {
  F reflects, back;  ///< its albedo, and the share of its light that returns to it
  F sunlit, skylit;  ///< its irradiance, were it black, by a beam and by a sky of radiance 1
};
template <class F>
LIMPID_INLINE F layer_at(const WaterMedium& m, std::size_t channel, const WaterPath<F>& path) {
  const F rate = given<F>(m.rates()[channel], "depth_fog.rate", static_cast<int>(channel));
  return layer_variable(min(rate * path.end, F(1e6)));
}
template <class F>
LIMPID_INLINE LitBottom<F> lit_bottom(const WaterMedium& m, std::size_t channel,
                                      const WaterPath<F>& path, F fallen, F albedo) {
  const ScatteredLight& light = m.multiple[channel];
  const F x = layer_at(m, channel, path);
  return {min(max(albedo, F(0)), F(ScatteredLight::kMaxAlbedo)),
          given<F>(light.back_at_once) + layer_power(light.back, x),
          given<F>(m.cosine, "depth_fog.cosine") * fallen + layer_power(light.sun_below, x),
          given<F>(light.sky_at_once) + layer_power(light.sky_below, x)};
}

/// The part of a path above a level floor, by its height over the floor: a path through water that
/// begins at the floor.
template <class F>
LIMPID_INLINE WaterPath<F> over_floor(const WaterPath<F>& path, F floor) {
  const F begin = max(floor - path.begin, F(0)), sink = F(0) - path.sink;
  const F room = select(sink < F(0), begin / max(F(0) - sink, F(1e-6)), F(3e38));
  const F length = min(path.length, room);
  return {length, sink, begin, max(begin + sink * length, F(0))};
}

/// For a view that begins in the water. The bottom is lit as that of a level layer of the `albedo`
/// around, and reflects by `detail` times as much; the water in front of it is as bright as if it
/// had the floor of the frame, if any.
template <class F>
LIMPID_INLINE MultipleLight<F> multiple_inside(const WaterMedium& m, std::size_t channel,
                                               const WaterPath<F>& path, F turned, F fallen, F left,
                                               F albedo, F detail) {
  const ScatteredLight& light = m.multiple[channel];
  const int place = static_cast<int>(channel);
  const F rate = given<F>(m.rates()[channel], "depth_fog.rate", place);
  const F beam = given<F>(m.beams()[channel], "depth_fog.beam", place);
  const F sky = given<F>(m.skies()[channel], "depth_fog.sky", place);
  struct {
    F sun, sky;
  } water{F(0), F(0)};
  if (m.scatters) {
    const auto by_sun =
        inside_sun_shapes(path.sink, turned, given<F>(m.square, "depth_fog.square"), m.turns);
    const auto by_sky = inside_sky_shapes(path.sink);
    for (std::size_t i = 0; i < ScatteredLight::kFades; ++i) {
      F of_sun(0), of_sky(0);
      for (std::size_t k = 0; k < ScatteredLight::kInside; ++k) {
        of_sun = of_sun + given<F>(light.inside_sun[i][k]) * by_sun[k];
        of_sky = of_sky + given<F>(light.inside_sky[i][k]) * by_sky[k];
      }
      const F column = sun_column(path, rate, given<F>(light.fades[i])).light;
      water = {water.sun + column * of_sun, water.sky + column * of_sky};
    }
    const F floor = given<F>(light.floor);
    if_any(floor > F(0), [&] {
      const WaterPath<F> rising = over_floor(path, floor);
      const F begin = min(path.begin, floor);
      const WaterPath<F> falling{rising.length, path.sink, begin, max(floor - rising.end, F(0))};
      for (std::size_t i = 0; i < ScatteredLight::kFloored; ++i) {
        F of_sun(0), of_sky(0);
        for (std::size_t k = 0; k < ScatteredLight::kInside; ++k) {
          of_sun = of_sun + given<F>(light.floor_sun[i][k]) * by_sun[k];
          of_sky = of_sky + given<F>(light.floor_sky[i][k]) * by_sky[k];
        }
        const F column = sun_column(i < ScatteredLight::kRising ? rising : falling, rate,
                                    given<F>(light.floor_fades[i]))
                             .light;
        water = {water.sun + column * of_sun, water.sky + column * of_sky};
      }
    });
  }
  const LitBottom<F> bottom = lit_bottom(m, channel, path, fallen, albedo);
  const F sharp = bottom.reflects * detail * left;
  const F seen = sharp / (F(1) - bottom.reflects * bottom.back);
  const F had = fallen * sharp * given<F>(m.per_bottom, "depth_fog.per_bottom");
  const F sunlit = max(seen * beam * bottom.sunlit -
                           had * given<F>(m.dry_suns()[channel], "depth_fog.dry_sun", place),
                       F(0));
  return {max(beam * water.sun, F(0)), max(sky * water.sky, F(0)),
          sunlit + seen * sky * bottom.skylit -
              had * given<F>(m.dry_skies()[channel], "depth_fog.dry_sky", place)};
}

/// Radiance at the near end of a path in the water, of an object at its far end whose radiance is
/// `light` when lit as in air: attenuated, plus the in-scatter of the path and the light that stays
/// between the bottom and the surface. `view`: unit, along the path; `albedo`: of the bottom around
/// the far end, and `detail` the object's over it.
template <class F>
Rgb<F> seen_in_water(const WaterMedium& m, const WaterPath<F>& path, const Vec3<F>& view,
                     Rgb<F> light, const Rgb<F>& albedo, const Rgb<F>& detail) {
  const MediumNumbers<F> numbers(m);
  const Rgb<F> rate = numbers.rate, down = numbers.down;
  const Rgb<F> left = transmittance(path.length, rate), fallen = transmittance(path.end, down);
  Rgb<F> seen = fallen * left * light;
  if (m.glows) seen = seen + ambient_in_scatter(numbers, path.length, left);
  const F turned = dot(numbers.to_sun, view);
  if (m.sunlit) {
    const Rgb<F> columns{sun_column(path, rate.r, down.r).light,
                         sun_column(path, rate.g, down.g).light,
                         sun_column(path, rate.b, down.b).light};
    const F phase = henyey_greenstein(turned, given<F>(m.anisotropy, "depth_fog.phase"));
    seen = seen + phase * (numbers.sun * columns);
  }
  if (!m.multiple) return seen;
  const auto more = [&](std::size_t channel, F fell, F stays, F around, F own) {
    const MultipleLight<F> multiple =
        multiple_inside(m, channel, path, turned, fell, stays, around, own);
    return multiple.sun + multiple.sky + multiple.bottom;
  };
  seen = seen + Rgb<F>{more(0, fallen.r, left.r, albedo.r, detail.r),
                       more(1, fallen.g, left.g, albedo.g, detail.g),
                       more(2, fallen.b, left.b, albedo.b, detail.b)};
  return {max(seen.r, F(0)), max(seen.g, F(0)), max(seen.b, F(0))};
}

}  // namespace limpid

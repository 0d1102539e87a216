#pragma once
#include "limpid/ops/depth_fog.h"

#include "op/bilinear.h"
#include "op/operator.h"
#include "op/water_medium.h"
#include "optics/fog.h"
#include "optics/refract.h"
#include "optics/scattering.h"

namespace limpid {

template <>
struct Kernel<DepthFog> : DepthFog {
  static constexpr StateSet kUses{StatePart::kPosition, StatePart::kPath, StatePart::kDryBottom,
                                  StatePart::kTransmitted};
  static constexpr StateSet kMakes{StatePart::kPath, StatePart::kTransmittance,
                                   StatePart::kTransmitted, StatePart::kInScatter,
                                   StatePart::kSunScatter};
  static PlaneSet reads(const Params& p) {
    if (!wants_scattered_light(p)) return {};
    return kAlbedoPlanes | PlaneSet{PlaneId::kBasin, PlaneId::kDepth, PlaneId::kShadow};
  }
  /// A given albedo is taken as it is.
  static PlaneSet wants(const Params& p, const AtHand& has) {
    const bool estimates = !has.planes.covers(kAlbedoPlanes);
    return estimates ? reads(p) : reads(p) - PlaneSet{PlaneId::kBasin};
  }
  static Needs needs(const Params&) { return {}; }
  static double reach(const Params&) { return 0; }
  static bool neutral(const Params& p, StateSet);
  /// Computes Params::fitted.
  static void work_in(const Primaries& primaries, Params& params);
  static double bound(const Params& params, const Pass& c, const Ranges& ranges);
  static void propagate_ranges(const Params& params, const Pass& c, Ranges& ranges);
  /// The largest change of the picture if the path through the water counts as endless and the
  /// light at its end as the pixel's own, because refraction is left out. 0 if not a bit of that
  /// light is left.
  static double beyond(const Params& params, const Pass& c, const Ranges& ranges);
  /// In water the path is measured from the eye and along the ray, for any `distance`.
  static PathMeasure path_measure(const Params& params);
  /// The bound of the operator that finds another place covers the fog there, but not the bottom's
  /// light that is added by the color there.
  static double displaced(const Params&, const Ranges& ranges) { return ranges.detail; }
  static double ns(const Params& p, const Running& running) {
    if (p.model == Model::kLinear) return 0.6;
    const PlaneSet all = running.planes | running.completed;
    return all.covers(kAlbedoPlanes | PlaneSet{PlaneId::kShadow}) ? 18 : 9;
  }
  /// Light lost per unit of the path: a + b of beer_lambert, less the narrow peak of
  /// radiative_transfer.
  static Rgb<double> extinction(const Params& params);
  /// Absorption and scattering that sediment and cdom add to the water of a type.
  static WaterCoefficients additions(const Params& params);
  static Rgb<double> absorption(const Params& params);
  static Rgb<double> scattering(const Params& params);
  /// Whether a frame needs multiple scattering, and of which water.
  static bool wants_scattered_light(const Params& params);
  static bool lit_by_sky(const Params& params) { return wants_scattered_light(params); }
  /// Mean depth, in scene units, at which endless water scatters the sunlight that it sends
  /// straight up, for green.
  static double lit_depth(const Params& params, const Pass& c);
  static ScatteringWater scattering_water(const Params& params, const Pass& c);
  /// None of `linear`, whose fog knows no light.
  static std::optional<WaterMedium> medium(const Params& params, const Pass& c);

  template <class Strip>
  static void apply(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    strip.each([&](Pixel<F>& p) { p.path = path_length(params.distance, c, p); });
    if (params.model == Model::kLinear) {
      linear(params, strip);
    } else {
      beer_lambert(params, c, strip);
    }
  }

 private:
  static WaterMedium medium_of(const Params& params, const Pass& c);
  static double brightest_phase(const Params& params, const Pass& c, const WaterMedium& medium);
  /// The largest multiple-scattered radiance of paths up to a length; and from a depth on, the
  /// largest difference of that radiance from endless water's.
  static double most_multiple(const WaterMedium& m, double path);
  static double beyond_multiple(const WaterMedium& m, double depth);

  template <class F>
  static LIMPID_INLINE F path_length(Distance distance, const Pass& c, const Pixel<F>& p) {
    F d = max(p.hit_depth - p.surface_depth, F(0));
    if (distance != Distance::kEye) d = p.ray_length * d;
    if (distance == Distance::kRefracted) {
      const F cosine = max(abs(dot(p.to_viewer, vec3_of<F>(c.up))), F(1e-6));  // against inf * 0
      d = c.made.has(StatePart::kPosition)
              ? p.path
              : d * cosine / refracted_cosine(cosine, given<F>(1 / c.ior, "water.per_ior"));
    }
    if (!c.submersible) return d;
    const F straight = p.ray_length * select(p.side < F(0), p.surface_depth, p.dry_depth);
    return select(p.side > F(0), d, straight);
  }

  template <class Strip>
  static void linear(const Params& params, Strip& strip) {
    using F = typename Strip::Number;
    const F density = given<F>(params.density), offset = given<F>(params.offset);
    const F alpha = given<F>(params.alpha);
    const Rgb<F> color{given<F>(params.color.r), given<F>(params.color.g),
                       given<F>(params.color.b)};
    strip.each([&](Pixel<F>& p) {
      const F veil = alpha * (F(1) - linear_fog(p.path, density, offset));
      const F clear = F(1) - veil;
      p.transmittance = {clear, clear, clear};
      p.transmitted = clear * p.transmitted;
      p.in_scatter = veil * color;
      p.sun_near = p.sun_far = p.sun_multiple = {F(0), F(0), F(0)};
      p.sun_entry = {F(0), F(0), F(0)};
      p.mean_scatter_distance = F(0);
    });
  }

  template <class Strip>
  static void beer_lambert(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const WaterMedium medium = medium_of(params, c);
    const MediumNumbers<F> numbers(medium);
    const Rgb<F> rate = numbers.rate, down = numbers.down;
    const Rgb<F> sun = numbers.sun;
    const Vec3<F> up = vec3_of<F>(c.up), to_sun = numbers.to_sun;
    const F eta = given<F>(1 / c.ior, "water.per_ior"), anisotropy = given<F>(params.anisotropy);
    const F bottom = given<F>(medium.bottom, "depth_fog.bottom");
    const F water = given<F>(medium.water, "depth_fog.water");
    const F per_rise =
        given<F>(medium.sunlit ? 1 / std::max(medium.cosine, 0.02) : 0, "depth_fog.per_rise");
    const F eye_depth = given<F>(c.eye_above < 0 ? -c.eye_above : 0, "camera.eye_below");
    const auto make = [&](Pixel<F>& p, const Reflector<F>& reflector) {
      // Of the view in the water: away from the viewer.
      const auto from_air = p.side > F(0);
      const Vec3<F> view =
          select(from_air, refract(p.to_viewer, up, eta).direction, F(-1) * p.to_viewer);
      const F length = min(p.path, F(3e38)), fall = F(0) - dot(view, up);
      const F sink = select(from_air, max(fall, F(0)), fall);  // against rounding
      const F begin = select(from_air, F(0), eye_depth);
      const WaterPath<F> path{length, sink, begin, max(begin + sink * length, F(0))};

      p.transmittance = transmittance(length, rate);
      // Seen from below, surfaces above the water are not lit through the water.
      const F under = select(p.side < F(0), F(0), path.end);
      const Rgb<F> fallen = transmittance(under, down);
      const Rgb<F> lit = select(from_air, bottom, F(1)) * fallen;
      p.transmitted = lit * p.transmittance * p.transmitted;

      p.in_scatter = p.sun_near = p.sun_far = p.sun_multiple = {F(0), F(0), F(0)};
      if (medium.glows) p.in_scatter = ambient_in_scatter(numbers, length, p.transmittance);
      const F turned = dot(to_sun, view);
      p.sun_entry = select(from_air, view + (sink * per_rise) * to_sun, {F(0), F(0), F(0)});
      p.mean_scatter_distance = F(0);
      if (medium.sunlit) {
        const F seen = select(from_air, water, F(1)) * henyey_greenstein(turned, anisotropy);
        // sun_left() of paths that begin at the surface and go down, as all paths from the air do:
        // the share of sunlight left at the viewer after the way down to the end of the path and
        // back.
        Rgb<F> left = p.transmittance * fallen;
        if_any(!from_air, [&] {
          left = select(from_air, left,
                        {sun_left(path, rate.r, down.r), sun_left(path, rate.g, down.g),
                         sun_left(path, rate.b, down.b)});
        });
        const SunColumn<F> red = sun_column(path, rate.r, down.r, left.r);
        const SunColumn<F> green = sun_column(path, rate.g, down.g, left.g);
        const SunColumn<F> blue = sun_column(path, rate.b, down.b, left.b);
        const Rgb<F> light = seen * (sun * Rgb<F>{red.light, green.light, blue.light});
        p.sun_far = light * Rgb<F>{red.far_share, green.far_share, blue.far_share};
        p.sun_near = light - p.sun_far;
        // On endless paths the share underflows in float.
        const F fading = max(rate.g + down.g * sink, F(1e-30));
        p.mean_scatter_distance =
            select(fading * length < F(1e3), green.far_share * length, F(1) / fading);
        p.in_scatter = p.in_scatter + light;
      }
      if (medium.multiple) add_multiple(medium, path, turned, fallen, reflector, p);
    };
    if (medium.multiple && c.planes.covers(kAlbedoPlanes)) {
      const bool detailed = c.planes.has(PlaneId::kShadow);
      strip.probe([&](Pixel<F>& p, const auto& tap) {
        const Rgb<F> albedo{tap.own(PlaneId::kAlbedoR), tap.own(PlaneId::kAlbedoG),
                            tap.own(PlaneId::kAlbedoB)};
        const Rgb<F> detail =
            detailed ? detail_at(medium, c, p, tap, albedo) : Rgb<F>{F(1), F(1), F(1)};
        make(p, {albedo, tap.own(PlaneId::kBasin), detail});
      });
    } else {
      const Rgb<F> none{F(0), F(0), F(0)};
      strip.each([&](Pixel<F>& p) { make(p, {none, F(1), none}); });
    }
  }

  /// What the bottom reflects.
  template <class F>
  struct Reflector {
    Rgb<F> albedo;  ///< of the bottom around
    F basin;        ///< its share that an endless floor as bright would have
    Rgb<F> detail;  ///< albedo of the visible point, over `albedo`
  };

  /// Reflector::detail: from the color of the dry picture and the light on a level floor there, by
  /// the shadow. 1 where the picture does not show the end of the ray: its shadow is that of what
  /// hides it.
  template <class F, class Tap>
  static LIMPID_INLINE Rgb<F> detail_at(const WaterMedium& m, const Pass& c, const Pixel<F>& p,
                                        const Tap& tap, const Rgb<F>& albedo) {
    const bool split = c.made.has(StatePart::kPrism), told = c.made.has(StatePart::kDryBottom);
    const Rgb<F>& color = told ? p.dry_bottom : p.transmitted;
    const auto quad = tap.quad(p.shift);
    const F hit = min(p.hit_depth, F(1e30));
    const F off = abs(bilinear_depth<F>(tap, PlaneId::kDepth, quad) - hit);
    const F shown = select(hit > F(0), saturate(F(2) - off / (F(0.02) * max(hit, F(1e-6)))), F(0));
    const F known = told ? max(shown, p.dry_lit_known) : shown;
    const F by_plane = mean_of<F>(quad, tap.read(PlaneId::kShadow, quad));
    const auto lit_at = [&](Vec2<F> shift) {
      const F lit = split ? bilinear<F>(tap, PlaneId::kShadow, shift) : by_plane;
      return told ? select(p.dry_lit_known > shown, p.dry_lit, lit) : lit;
    };
    return {albedo_detail(m, 0, color.r, lit_at(p.shift_r), albedo.r, known),
            albedo_detail(m, 1, color.g, lit_at(p.shift_g), albedo.g, known),
            albedo_detail(m, 2, color.b, lit_at(p.shift_b), albedo.b, known)};
  }

  /// Light that is scattered more than once, and of the bottom what `transmitted` lacks.
  template <class F>
  static LIMPID_INLINE void add_multiple(const WaterMedium& m, const WaterPath<F>& path, F turned,
                                         const Rgb<F>& fallen, const Reflector<F>& bottom,
                                         Pixel<F>& p) {
    const auto from_air = p.side > F(0);
    const F doubly =
        m.turns ? henyey_greenstein(turned, given<F>(m.square, "depth_fog.square")) : F(0);
    const std::array<F, 4> shapes{F(1), path.sink, turned, doubly};
    const Rgb<F>& left = p.transmittance;
    const Rgb<F> level = bottom.basin * bottom.albedo;
    const auto down = [&](std::size_t i, F fell, F stays, F albedo, F detail) {
      return multiple_down(m, i, path, shapes, fell, stays, albedo, detail);
    };
    MultipleLight<F> red = down(0, fallen.r, left.r, level.r, bottom.detail.r);
    MultipleLight<F> green = down(1, fallen.g, left.g, level.g, bottom.detail.g);
    MultipleLight<F> blue = down(2, fallen.b, left.b, level.b, bottom.detail.b);
    if (m.inside) {
      if_any(!from_air, [&] {
        // Seen from below, surfaces above the water are no bottom.
        const Rgb<F> under = select(p.side < F(0), {F(0), F(0), F(0)}, bottom.albedo);
        const auto choose = [&](std::size_t i, MultipleLight<F>& own, F fell, F stays, F albedo,
                                F detail) {
          const MultipleLight<F> inside =
              multiple_inside(m, i, path, turned, fell, stays, albedo, detail);
          own = {select(from_air, own.sun, inside.sun), select(from_air, own.sky, inside.sky),
                 select(from_air, own.bottom, inside.bottom)};
        };
        choose(0, red, fallen.r, left.r, under.r, bottom.detail.r);
        choose(1, green, fallen.g, left.g, under.g, bottom.detail.g);
        choose(2, blue, fallen.b, left.b, under.b, bottom.detail.b);
      });
    }
    const Rgb<F> seen = p.transmitted + Rgb<F>{red.bottom, green.bottom, blue.bottom};
    p.transmitted = {max(seen.r, F(0)), max(seen.g, F(0)), max(seen.b, F(0))};
    p.sun_multiple = {red.sun, green.sun, blue.sun};
    const Rgb<F> all = p.in_scatter + p.sun_multiple + Rgb<F>{red.sky, green.sky, blue.sky};
    p.in_scatter = {max(all.r, F(0)), max(all.g, F(0)), max(all.b, F(0))};
    if (m.inside) {
      // This light entered above the viewer, not where the view meets the surface: no shadow is
      // known for it.
      p.sun_multiple = select(from_air, p.sun_multiple, {F(0), F(0), F(0)});
    }
  }

  /// For a view from the air.
  /// `fallen` and `left`: the shares left of the beam at the end of the path, and of its light at
  /// the viewer; `albedo`, `detail`: as in Reflector, of an endless floor.
  template <class F>
  static LIMPID_INLINE MultipleLight<F> multiple_down(const WaterMedium& m, std::size_t channel,
                                                      const WaterPath<F>& path,
                                                      const std::array<F, 4>& shapes, F fallen,
                                                      F left, F albedo, F detail) {
    const ScatteredLight& light = m.multiple[channel];
    const int place = static_cast<int>(channel);
    const std::array<F, 2> even{shapes[0], shapes[1]};
    const F x = layer_at(m, channel, path);
    const F beam = given<F>(m.beams()[channel], "depth_fog.beam", place);
    const F sky = given<F>(m.skies()[channel], "depth_fog.sky", place);
    const F water = given<F>(m.water, "depth_fog.water");
    struct {
      F sun, sky;
    } up{F(0), F(0)};
    if (m.scatters) {
      const F many = m.turns ? layer_power(light.sun, shapes, x)
                             : layer_power(std::array{light.sun[0], light.sun[1]}, even, x);
      up = {beam * (F(1) - fallen * left) * many, sky * layer_power(light.sky, even, x)};
    }
    const LitBottom<F> bottom = lit_bottom(m, channel, path, fallen, albedo);
    // Unscattered light has the albedo of the point, scattered light that of the bottom around it.
    const F sharp = detail * left, passing = sharp + layer_power(light.passing, even, x);
    const F reflects = bottom.reflects / (F(1) - bottom.reflects * bottom.back);
    const F had = bottom.reflects * fallen * sharp,
            of_sharp = saturate(sharp / max(passing, F(1e-30)));
    const F sunlit = water * (reflects * passing * beam * bottom.sunlit);
    const F skylit = water * (reflects * passing * sky * bottom.skylit);
    const F more =
        max(sunlit - had * given<F>(m.dry_suns()[channel], "depth_fog.dry_sun", place), F(0));
    // Sunlight that comes back to the bottom fell on it far around: Reflector::basin has that
    // shade.
    const F again = min(bottom.reflects * bottom.back * sunlit, more);
    // The sky's light in `transmitted` was dimmed as sunlight, and may be too bright.
    return {water * up.sun + (more - again), water * up.sky + (F(1) - of_sharp) * (again + skylit),
            of_sharp * (again + skylit) -
                had * given<F>(m.dry_skies()[channel], "depth_fog.dry_sky", place)};
  }
};

}  // namespace limpid

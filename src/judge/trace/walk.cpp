#include "judge/trace/walk.h"

#include <algorithm>
#include <cmath>

#include "judge/trace/bend.h"
#include "judge/trace/directions.h"
#include "optics/absorption.h"
#include "optics/fresnel.h"

namespace limpid::trace {
namespace {

constexpr Rgb<double> kBlack{0, 0, 0};

/// Paths carry no footprint: textures are sampled at their finest level.
Beam beam_of(const Ray& ray) { return {ray, ray, ray}; }

}  // namespace

Rgb<double> Walk::scattered(const Ray& ray, double length, const Band& band,
                            Samples& samples) const {
  const Rgb<double>& rate = medium_.rate;
  RandomPath path{.chances = Chances(band.mask, samples.next())};
  // Every path is scattered before it ends, and represents only scattered paths.
  const auto share = [&](double of) { return -std::expm1(-of * std::min(length, kInfinitePath)); };
  const Rgb<double> shares{share(rate.r), share(rate.g), share(rate.b)};
  const double drawn = path.chances.drawn(shares);
  if (!(drawn > 0)) return kBlack;
  const double s = -std::log1p(-samples.next() * drawn) / path.chances.drawn(rate);
  const auto over = [](double chance, double of) { return of > 0 ? chance / of : 0; };
  const Rgb<double> chance = rate * transmittance(s, rate);
  path.chances.go_on(
      {over(chance.r, shares.r), over(chance.g, shares.g), over(chance.b, shares.b)});
  path.ray = ray;
  if (scatter(path, ray.at(s), band, samples)) go(path, band, samples);
  return shares * path.light;
}

Rgb<double> Walk::bottom(const SolidPoint& point, const Beam& beam, const Band& band,
                         Samples& samples) const {
  RandomPath path{.chances = Chances(band.mask, samples.next())};
  path.light = band.mask * own_light(point, beam, band, samples);
  if (bounce(path, point, samples)) go(path, band, samples);
  return path.light;
}

Rgb<double> Walk::dry(const SolidPoint& point, const Beam& beam) const {
  return solid_.color(point, beam, sun_, [&] {
    return solid_.blocks({point.off_towards(sun_.to_sun), sun_.to_sun}) ? 0.0 : 1.0;
  });
}

void Walk::go(RandomPath& path, const Band& band, Samples& samples) const {
  while (path.in_air ? through_air(path, band, samples) : through_water(path, band, samples)) {
  }
}

std::optional<SolidPoint> Walk::nearest(const Ray& ray) const {
  return solid_.nearest(beam_of(ray), Opacity::kBlocking);
}

/// Extends the path to a scattering, to the bottom, or to the surface.
Walk::Going Walk::through_water(RandomPath& path, const Band& band, Samples& samples) const {
  const std::optional<SolidPoint> dry = nearest(path.ray);
  Ray before = path.ray;
  if (dry) before.to = std::min(before.to, dry->hit.distance);
  const std::optional<SurfacePoint> wet = surface_.from_below(before);
  const double length = wet ? wet->distance : dry ? dry->hit.distance : HUGE_VAL;
  const double s = -std::log1p(-samples.next()) / path.chances.drawn(medium_.rate);
  if (s < length) {
    path.chances.go_on(medium_.rate * transmittance(s, medium_.rate));
    return scatter(path, path.ray.at(s), band, samples);
  }
  if (!wet && !dry) return false;
  path.chances.go_on(transmittance(length, medium_.rate));
  if (wet) return meet_surface(path, *wet, band, samples);
  if (!path.from_dry) {
    path.light = path.light + path.scale * (path.chances.worth() *
                                            own_light(*dry, beam_of(path.ray), band, samples));
  }
  return bounce(path, *dry, samples);
}

/// Out of the water: to the sky or to a dry surface, which is shaded as in the raster pass; or down
/// into a wave.
Walk::Going Walk::through_air(RandomPath& path, const Band& band, Samples& samples) const {
  const std::optional<SolidPoint> dry = nearest(path.ray);
  if (medium_.crosses) {
    Ray before = path.ray;
    if (dry) before.to = std::min(before.to, dry->hit.distance);
    if (const auto wet = surface_.nearest(before, true)) {
      const double cosine = glm::dot(-path.ray.direction, wet->normal);
      if (samples.next() < fresnel_exact(cosine, band.ior)) {
        path.ray = mirrored_up(beam_of(path.ray), *wet).ray;
      } else {
        path.ray = refracted_in(beam_of(path.ray), *wet, band.ior).ray;
        path.scale /= band.square;
        path.in_air = false;
      }
      return true;
    }
  }
  const Rgb<double> end = dry ? this->dry(*dry, beam_of(path.ray)) : sky_.from(path.ray.direction);
  path.light = path.light + path.scale * (path.chances.worth() * end);
  return false;
}

/// Adds the sun's light from there, and continues in a random direction.
Walk::Going Walk::scatter(RandomPath& path, const glm::dvec3& at, const Band& band,
                          Samples& samples) const {
  path.from_dry = false;
  if (band.sun_on_water != kBlack && sun_path_.reaches(at, band)) {
    const double turned =
        henyey_greenstein(glm::dot(band.light.to_sun, path.ray.direction), medium_.anisotropy);
    path.light =
        path.light + (path.scale * turned) * (path.chances.worth() * medium_.albedo *
                                              band.sun_on_water * sun_path_.left_at(at, band));
  }
  if (samples.next() >= path.chances.drawn(medium_.albedo) || lost_below(at)) return false;
  path.chances.go_on(medium_.albedo);
  const double u = samples.next();
  path.ray = {at, scattered_direction(path.ray.direction, medium_.anisotropy, u, samples.next())};
  return true;
}

/// Reflects the path at a dry surface in the water, with the probability of its color.
Walk::Going Walk::bounce(RandomPath& path, const SolidPoint& point, Samples& samples) const {
  const Rgb<double> albedo = solid_.albedo(point);
  if (samples.next() >= path.chances.drawn(albedo)) return false;
  path.chances.go_on(albedo);
  const double u = samples.next();
  const glm::dvec3 direction = diffuse_direction(point.normal, u, samples.next());
  if (!(glm::dot(direction, point.face) > 0)) return false;
  path.ray = {point.off_towards(direction), direction};
  path.from_dry = true;
  return true;
}

/// Reflects or transmits the path at the surface.
Walk::Going Walk::meet_surface(RandomPath& path, const SurfacePoint& at, const Band& band,
                               Samples& samples) const {
  if (!medium_.crosses) {
    path.ray = {at.point, path.ray.direction};
  } else {
    const double cosine = glm::dot(path.ray.direction, at.normal);
    if (samples.next() < fresnel_exact(cosine, 1 / band.ior)) {
      path.ray = mirrored_down(beam_of(path.ray), at).ray;
      path.from_dry = false;
      return true;
    }
    path.ray = refracted_out(beam_of(path.ray), at, band.ior).ray;
    path.scale *= band.square;
  }
  path.in_air = true;
  return !path.from_dry;
}

/// A dry surface's own light from sun and sky, through the water over it.
Rgb<double> Walk::own_light(const SolidPoint& point, const Beam& beam, const Band& band,
                            Samples& samples) const {
  Sunlight sun{band.light.to_sun, 1, band.sun_on_bottom};
  if (sun.color != kBlack) sun.color = sun.color * sun_path_.left_at(point.hit.point, band);
  const Rgb<double> lit = solid_.color(point, beam, sun, [&] { return sunlit(point, band); });
  const Rgb<double> ambient = solid_.ambient_light(point);
  if (ambient == kBlack) return lit;
  return lit - ambient + skylight_at(point.hit.point, band, samples) * ambient;
}

/// Share of the calm plane's sunlight, above 1 at foci.
double Walk::sunlit(const SolidPoint& point, const Band& band) const {
  if (caustics_) {
    if (const std::optional<double> focused = caustics_->at(point)) return *focused;
  }
  return sun_path_.reaches(point.off_towards(band.light.to_sun), band) ? 1 : 0;
}

/// Share of an even sky's light that comes straight down to a level surface there, by one random
/// direction.
Rgb<double> Walk::skylight_at(const glm::dvec3& point, const Band& band, Samples& samples) const {
  const double cosine = std::sqrt(samples.next());
  const double enters = medium_.crosses ? 1 - fresnel_exact(cosine, 1 / band.ior) : 1;
  if (enters == 0) return kBlack;
  const double path = sun_path_.depth_of(point) / std::max(cosine, 1e-30);
  return enters * band.square * transmittance(path, medium_.rate);
}

/// Without absorption paths would descend forever.
bool Walk::lost_below(const glm::dvec3& point) const {
  const Rgb<double>& rate = medium_.rate;
  const double least = std::min({rate.r, rate.g, rate.b}) * (1 - medium_.anisotropy);
  return sun_path_.depth_of(point) * least > 2000;
}

}  // namespace limpid::trace

#include "judge/trace/tracer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "judge/trace/bend.h"
#include "judge/trace/one_pixel.h"
#include "ops/sun_highlight_kernel.h"
#include "optics/fresnel.h"
#include "optics/scattering.h"

namespace limpid::trace {
namespace {

constexpr Rgb<double> kBlack{0, 0, 0};

Sunlight in_the_air(const Scene& scene) {
  if (!scene.sun) return {};
  return {scene.sun->direction, 1, scene.sun->color};
}

/// The sky of the scene, or else of the look.
Rgb<double> even_sky(const Scene& scene, const Look& look) {
  return scene.sky ? scene.sky->radiance : look.of<DepthFog>().ambient;
}

/// The beam behind a point of a blended surface.
Beam beyond(const Beam& beam, const SolidPoint& point) {
  Beam on = turned(beam, point.hit.point, point.face, [](const glm::dvec3& d) { return d; });
  on.ray.origin -= point.hit.slack * point.face;
  return on;
}

}  // namespace

Tracer::Tracer(const Model& model, const Scene& scene, const Look& look,
               const TruthOptions& options, const Pass& pass, const Eye& eye, Executor& executor)
    : pass_(pass),
      look_(look),
      light_(options.light),
      environment_(options.environment),
      background_(model.background),
      sun_(in_the_air(scene)),
      medium_(pass, look, options.light),
      solid_(model, pass.eye),
      surface_(model, scene, look, options.wave_map, pass),
      sun_path_(pass, solid_, medium_, sun_.to_sun),
      sky_(pass, environment_, even_sky(scene, look)),
      caustics_(caustics_of(options, eye, executor)),
      walk_(solid_, surface_, medium_, sun_path_, sun_, sky_, caustics_ ? &*caustics_ : nullptr) {}

std::optional<Caustics> Tracer::caustics_of(const TruthOptions& options, const Eye& eye,
                                            Executor& executor) const {
  const bool wanted = light_ == TruthOptions::Light::kPaths && options.photons > 0;
  if (!wanted || !medium_.bends_sun) return std::nullopt;
  return std::make_optional<Caustics>(
      Caustics::Scenery{pass_, solid_, surface_, medium_, sun_path_, sun_.to_sun}, eye,
      options.size, options.photons, options.seed, executor);
}

Light Tracer::seen(const Beam& beam, bool in_water, int steps, Samples& samples,
                   Samples& paths) const {
  View view{.steps = steps, .samples = samples, .paths = paths};
  view.from_air = !in_water;
  return in_water ? from_water(beam, view) : in_air(beam, view);
}

std::optional<SolidPoint> Tracer::nearest_dry(const Beam& beam, const View& view) const {
  return solid_.nearest(beam, view.layers < kBlendedLayers ? Opacity::kSeen : Opacity::kSolid);
}

/// The light behind a blended surface, composited with the surface.
Light Tracer::through_layer(const SolidPoint& layer, const Beam& beam, View view) const {
  ++view.layers;
  Light light = in_air(beyond(beam, layer), view);
  const double left = 1 - layer.opacity;
  light.transmitted = left * light.transmitted + layer.opacity * walk_.dry(layer, beam);
  light.in_scatter = left * light.in_scatter;
  light.reflected = left * light.reflected;
  light.highlight = left * light.highlight;
  return light;
}

Light Tracer::in_air(const Beam& beam, View view) const {
  Light light;
  const std::optional<SolidPoint> dry = nearest_dry(beam, view);
  std::optional<SurfacePoint> wet;
  if (view.events < kTruthEvents) {
    Ray ray = beam.ray;
    if (dry) ray.to = std::min(ray.to, dry->hit.distance);
    wet = surface_.nearest(ray, true);
  }
  if (!wet && dry && dry->opacity < 1) return through_layer(*dry, beam, view);
  if (!wet) {
    light.transmitted = dry ? walk_.dry(*dry, beam) : background(beam.ray.direction, view);
    return light;
  }
  ++view.events;
  const glm::dvec3 to_viewer = -beam.ray.direction;
  light.highlight = highlight(*wet, to_viewer);

  View mirrored = view;
  mirrored.mirrored = true;
  const Rgb<double> above = in_air(mirrored_up(beam, *wet), mirrored).sum();
  const double cosine = glm::dot(to_viewer, wet->normal);
  light.transmittance = kBlack;
  for (const Band& band : medium_.bands) {
    const double share = fresnel_exact(cosine, band.ior);
    const Leg leg = through_water(refracted_in(beam, *wet, band.ior), band, view);
    light.reflected = light.reflected + share * (band.mask * above);
    light.transmitted =
        light.transmitted + (1 - share) * (band.mask * (leg.through + leg.mirrored));
    light.in_scatter = light.in_scatter + (1 - share) * (band.mask * leg.in_scatter);
    light.transmittance = light.transmittance + band.mask * leg.transmittance;
  }
  light.fresnel = fresnel_exact(cosine, medium_.bands[medium_.common].ior);
  return light;
}

Light Tracer::from_water(const Beam& beam, View view) const {
  Light light;
  light.transmittance = kBlack;
  for (std::size_t i = 0; i < medium_.bands.size(); ++i) {
    const Band& band = medium_.bands[i];
    const Leg leg = through_water(beam, band, view);
    light.transmitted = light.transmitted + band.mask * leg.through;
    light.reflected = light.reflected + band.mask * leg.mirrored;
    light.in_scatter = light.in_scatter + band.mask * leg.in_scatter;
    light.transmittance = light.transmittance + band.mask * leg.transmittance;
    if (i == medium_.common) light.fresnel = leg.fresnel;
  }
  return light;
}

/// The path to a blended surface, the surface, and the path behind it.
Tracer::Leg Tracer::through_layer(const SolidPoint& layer, const Beam& beam, const Band& band,
                                  View view) const {
  ++view.layers;
  const double length = layer.hit.distance;
  const Rgb<double> before = transmittance(length, medium_.rate);
  Leg leg = through_water(beyond(beam, layer), band, view);
  const Rgb<double> left = (1 - layer.opacity) * before;
  leg.through = left * leg.through + layer.opacity * end_light(&layer, beam, length, band, view);
  leg.mirrored = left * leg.mirrored;
  leg.in_scatter = scattered(beam.ray, length, band, view) + left * leg.in_scatter;
  leg.transmittance = before * leg.transmittance;
  return leg;
}

/// Light from the end of a path through the water: of a dry surface, or none.
Rgb<double> Tracer::end_light(const SolidPoint* dry, const Beam& beam, double length,
                              const Band& band, const View& view) const {
  const Rgb<double> end =
      dry ? bottom_light(*dry, beam, band, view) : background(beam.ray.direction, view);
  const Rgb<double> arrives = transmittance(length, medium_.rate) * end;
  if (light_ == TruthOptions::Light::kPaths && dry) return arrives;
  const double depth = sun_path_.depth_of(dry ? dry->hit.point : beam.ray.at(length));
  const double leaves = view.from_air ? band.light.bottom : 1;
  return leaves * (transmittance(depth, band.light.down) * arrives);
}

/// With random paths: the light left in the air; else before the losses at the surface and in the
/// water over it.
Rgb<double> Tracer::bottom_light(const SolidPoint& point, const Beam& beam, const Band& band,
                                 const View& view) const {
  if (light_ == TruthOptions::Light::kOnce) return bottom_lit_once(point, beam, band);
  return (view.from_air ? 1 / band.square : 1) * walk_.bottom(point, beam, band, view.paths);
}

Tracer::Leg Tracer::through_water(const Beam& beam, const Band& band, View view) const {
  const std::optional<SolidPoint> dry = nearest_dry(beam, view);
  std::optional<SurfacePoint> wet;
  if (view.events < kTruthEvents) {
    Ray ray = beam.ray;
    if (dry) ray.to = std::min(ray.to, dry->hit.distance);
    wet = surface_.nearest(ray, false);
  }
  if (!wet && dry && dry->opacity < 1) return through_layer(*dry, beam, band, view);
  const double length = wet ? wet->distance : dry ? dry->hit.distance : kInfinitePath;
  Leg leg;
  leg.transmittance = transmittance(length, medium_.rate);
  leg.in_scatter = scattered(beam.ray, length, band, view);
  if (!wet) {
    leg.through = end_light(dry ? &*dry : nullptr, beam, length, band, view);
    return leg;
  }
  ++view.events;
  View mirrored = view;
  mirrored.mirrored = true;
  leg.fresnel = fresnel_exact(glm::dot(beam.ray.direction, wet->normal), 1 / band.ior);
  const Leg below = through_water(mirrored_down(beam, *wet), band, mirrored);
  leg.mirrored =
      leg.fresnel * (leg.transmittance * (below.through + below.mirrored + below.in_scatter));
  if (leg.fresnel < 1) {
    const Rgb<double> above = in_air(refracted_out(beam, *wet, band.ior), view).sum();
    leg.through = (1 - leg.fresnel) * (leg.transmittance * above);
  }
  return leg;
}

Rgb<double> Tracer::scattered(const Ray& ray, double length, const Band& band,
                              const View& view) const {
  if (light_ == TruthOptions::Light::kOnce) return scattered_once(ray, length, band, view);
  return (view.from_air ? 1 / band.square : 1) * walk_.scattered(ray, length, band, view.paths);
}

Rgb<double> Tracer::scattered_once(const Ray& ray, double length, const Band& band,
                                   const View& view) const {
  const Rgb<double>& rate = medium_.rate;
  const Rgb<double> everywhere =
      medium_.ambient * Rgb<double>{column_light(rate.r, length), column_light(rate.g, length),
                                    column_light(rate.b, length)};
  if (band.light.sun == kBlack) return everywhere;
  // Values of other bands are not computed.
  const auto sunlit = [&](double own_rate, double down, double own) {
    return own == 0 ? 0.0 : sunlit_column(ray, length, own_rate, down, band, view);
  };
  const Rgb<double>& down = band.light.down;
  const Rgb<double> column{sunlit(rate.r, down.r, band.mask.r), sunlit(rate.g, down.g, band.mask.g),
                           sunlit(rate.b, down.b, band.mask.b)};
  const double turned =
      henyey_greenstein(glm::dot(band.light.to_sun, ray.direction), medium_.anisotropy);
  const double leaves = view.from_air ? band.light.water : 1;
  return everywhere + (leaves * turned) * (band.light.sun * column);
}

/// sun_column() of a path whose part above the calm plane, under a crest, has lost no sunlight,
/// times the share of it that the sun reaches.
double Tracer::sunlit_column(const Ray& ray, double length, double rate, double down,
                             const Band& band, const View& view) const {
  const double sinks = -glm::dot(ray.direction, pass_.up);
  const double begin = sun_path_.under_calm(ray.origin), end = begin + sinks * length;
  const double crossing = begin * end < 0 ? -begin / sinks : length;
  struct Part {
    double from, length, begin, end, light;
  };
  Part parts[] = {{0, crossing, begin, begin + sinks * crossing, 0},
                  {crossing, length - crossing, 0, end, 0}};
  double whole = 0;
  for (Part& p : parts) {
    if (!(p.length > 0)) continue;
    const bool above = p.begin + p.end < 0;
    const WaterPath<double> path{p.length, sinks, std::max(p.begin, 0.0), std::max(p.end, 0.0)};
    p.light = std::exp(-rate * p.from) * sun_column(path, rate, above ? 0 : down).light;
    whole += p.light;
  }
  double reached = 0;
  for (const Part& p : parts) {
    if (!(p.light > 0)) continue;
    const bool above = p.begin + p.end < 0;
    const int steps = std::max(1, static_cast<int>(std::lround(view.steps * p.light / whole)));
    const Ray part{ray.at(p.from), ray.direction};
    reached += p.light *
               sunlit_share(part, p.length, above ? rate : rate + down * sinks, steps, band, view);
  }
  return reached;
}

/// Mean of the sun's visibility along the path, weighted by the unshadowed light: exp(-loss s).
/// Places are drawn by that weight, one in each of `steps` parts of equal light.
double Tracer::sunlit_share(const Ray& ray, double length, double loss, int steps, const Band& band,
                            const View& view) const {
  const double size = std::abs(loss), whole = size * std::min(length, kInfinitePath);
  int reached = 0;
  for (int i = 0; i < steps; ++i) {
    const double part = (i + view.samples.next()) / steps;
    double s = part * length;
    if (whole > 1e-6) s = -std::log1p(part * std::expm1(-whole)) / size;
    if (loss < 0) s = length - s;
    reached += sun_path_.reaches(ray.at(s), band);
  }
  return static_cast<double>(reached) / steps;
}

Rgb<double> Tracer::bottom_lit_once(const SolidPoint& point, const Beam& beam,
                                    const Band& band) const {
  if (!medium_.bends_sun || sun_path_.depth_of(point.hit.point) <= 0) return walk_.dry(point, beam);
  // A totally reflected sun gives no light.
  const Sunlight sun{band.light.to_sun, band.light.spread,
                     band.light.spread > 0 ? sun_.color : kBlack};
  return solid_.color(point, beam, sun, [&] {
    return sun_path_.reaches(point.off_towards(band.light.to_sun), band) ? 1.0 : 0.0;
  });
}

Rgb<double> Tracer::background(const glm::dvec3& direction, const View& view) const {
  using Source = FresnelReflection::Source;
  const FresnelReflection::Params& mirror = look_.of<FresnelReflection>();
  if (view.mirrored && mirror.source == Source::kConstant) return mirror.color;
  if (view.mirrored && mirror.source == Source::kEnvironment && environment_) {
    return environment_at(environment_, pass_, direction);
  }
  return background_;
}

Rgb<double> Tracer::highlight(const SurfacePoint& at, const glm::dvec3& to_viewer) const {
  const SunHighlight::Params& params = look_.of<SunHighlight>();
  if (!pass_.has_sun || Kernel<SunHighlight>::neutral(params, {})) return kBlack;
  Pixel<double> pixel{};
  pixel.side = 1;
  pixel.to_viewer = formula_of(to_viewer);
  pixel.normal = formula_of(at.normal);
  OnePixel strip(pixel);
  Kernel<SunHighlight>::apply(params, pass_, strip);
  const bool faces = glm::dot(at.normal, sun_.to_sun) > 0;
  if (pixel.highlight == kBlack || !faces) return kBlack;
  return solid_.blocks({at.point, sun_.to_sun}) ? kBlack : pixel.highlight;
}

}  // namespace limpid::trace

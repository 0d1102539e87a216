#include "complete/completer.h"

#include <string_view>

#include "complete/sky_radiance.h"
#include "complete/surroundings.h"
#include "complete/water_floor.h"
#include "ops/caustics_kernel.h"
#include "ops/depth_fog_kernel.h"
#include "ops/water_shadow_kernel.h"
#include "ops/wave_normals_kernel.h"

namespace limpid {
namespace {

/// If the plane is present, the completer of this name makes a repaired one.
PlaneSet made_by(std::string_view name, const Plan& plan, const Frame& frame) {
  for (const CompleterInfo& completer : completers()) {
    if (completer.name != name || !frame.present().covers(completer.inputs)) continue;
    return plan.completed & ((completer.makes - frame.present()) | completer.corrects);
  }
  return {};
}

void take(PlaneSet made, PlaneId plane, const Plane& with, Frame& frame) {
  if (made.has(plane)) frame.planes[index_of(plane)] = with.view();
}

/// Whether mirrored rays look up the dry picture.
bool mirrors_picture(const Plan& plan, PlaneSet planes, bool submersible) {
  return plan.keeps<FresnelReflection>() &&
         plan.look.of<FresnelReflection>().source == FresnelReflection::Source::kAuto &&
         planes.covers(kColorPlanes | PlaneSet{PlaneId::kDepth}) &&
         (submersible || !(planes & plan.planes).covers(kReflectionPlanes));
}

}  // namespace

Frame Completer::complete(const Plan& plan, const Frame& frame, const Pass& pass,
                          Executor& executor, const std::string* simd) {
  Frame whole = frame;
  if (pass.off_centre != glm::dvec2(0, 0)) part_depths_.move(whole, pass, executor);
  if (plan.planes.covers(kBelowPlanes) && frame.present().covers(kBelowPlanes)) {
    below_overscan_.widen(whole, pass, executor);
  }
  complete_surface(made_by("displaced_surface", plan, frame), pass, executor, simd, whole);
  if (plan.look.water.edges == Water::Edges::kMixed) edges_.make(whole, pass, executor);
  if (const PlaneSet made = made_by("surface_shadow", plan, frame); !made.empty()) {
    surface_shadow_.make(whole, pass, executor);
    take(made, PlaneId::kSurfaceShadow, surface_shadow_.plane(), whole);
  }
  if (const PlaneSet made = made_by("mirror_depth", plan, frame); !made.empty()) {
    mirror_depth_.make(whole, pass, executor);
    take(made, PlaneId::kReflectionDepth, mirror_depth_.depth(), whole);
    take(made, PlaneId::kReflectionValid, mirror_depth_.valid(), whole);
  }
  complete_sky(made_by("sky", plan, frame), plan, pass, executor, whole);
  if (mirrors_picture(plan, whole.present(), pass.submersible)) {
    whole.edge_surfaces = edge_surfaces_.make(whole, pass, executor);
  }
  complete_plate_waves(plan, frame.present() & plan.planes, pass, whole);
  complete_waves(plan, pass, executor, whole);
  complete_water(plan, made_by("bottom_albedo", plan, frame), true, pass, executor, whole);
  const Refraction::Params& refraction = plan.look.of<Refraction>();
  if (!plan.made.has(StatePart::kPosition)) return whole;
  if (refraction.continues_bottom()) whole.continuation = continuation_maker_.make(whole, pass);
  const Caustics::Params& caustics = plan.look.of<Caustics>();
  // A host may pass more planes than the plan reads; jobs do not read those.
  const PlaneSet read = plan.planes | plan.completed;
  Pass now = pass;
  now.planes = whole.present();
  now.wave_variance = whole.wave_variance;
  if (whole.sky_radiance) now.has_sky = true, now.sky = *whole.sky_radiance;
  std::array<double, 3> sun_over_rest{};
  const bool refracted = caustics.sunlight == Caustics::Sunlight::kRefracted;
  if (plan.keeps<Caustics>() && (refracted || now.planes.covers(kSunColorPlanes))) {
    sun_over_rest =
        sun_share_.over_rest(whole, now, Kernel<Caustics>::sun_over_sky(caustics, now), executor);
  }
  if (refraction.uses_bottom_layer()) {
    const bool shades = plan.keeps<Caustics>() &&
                        Kernel<Caustics>::knows_entries(caustics, pass, now.planes & read);
    whole.bottom_layer =
        bottom_layer_.make(whole, pass, shades ? sun_over_rest : std::array<double, 3>{}, executor);
  }
  const WaterShadow::Params& shade = plan.look.of<WaterShadow>();
  const bool shafts = plan.keeps<WaterShadow>() && Kernel<WaterShadow>::wants_shafts(shade);
  if (plan.keeps<Caustics>() || shafts) {
    const DepthFog::Params& water = plan.look.of<DepthFog>();
    const bool scatters = plan.keeps<DepthFog>() && water.model != DepthFog::Model::kLinear;
    const Rgb<double> scattering =
        scatters ? Kernel<DepthFog>::scattering(water) : Rgb<double>{0, 0, 0};
    const WaveNormals::Params* waves = &plan.look.of<WaveNormals>();
    light_ = {};
    if (plan.keeps<Caustics>()) {
      const bool focuses = caustics.strength != 0;
      light_ = *caustics_.make(focuses ? waves : nullptr, scattering, whole, now, executor, simd);
      light_.sun_over_rest = sun_over_rest;
      light_.slopes = has_fine_depth(frame) ? 1 : 0;  // completed depths are always fine
      light_.under_land = (frame.present() & plan.planes).has(PlaneId::kSurfaceDepth) ? 0 : 1;
    }
    if (shafts) {
      light_.in_water = shafts_.make(waves, scattering, whole, now, executor, simd,
                                     Kernel<DepthFog>::lit_depth(water, now));
    }
    whole.caustics = &light_;
    if (plan.keeps<Caustics>() && plan.keeps<FresnelReflection>()) {
      if (!read.has(PlaneId::kSurfaceShadow)) {
        now.planes = now.planes - PlaneSet{PlaneId::kSurfaceShadow};
      }
      mirrored_caustics_.light(caustics, light_, now, executor, whole);
    }
  }
  return whole;
}

Frame Completer::complete_windows(const Plan& plan, const Frame& frame, const Pass& pass,
                                  Executor& executor, const std::string& simd) {
  Frame whole = frame;
  complete_surface(made_by("displaced_surface", plan, frame), pass, executor, &simd, whole);
  complete_waves(plan, pass, executor, whole);
  complete_water(plan, {}, false, pass, executor, whole);
  return whole;
}

std::vector<std::string> Completer::made_of_pixels(const Plan& plan, bool has_sky) {
  std::vector<std::string> phrases;
  if (plan.look.water.edges == Water::Edges::kMixed) {
    phrases.emplace_back("mixed edges (water.edges)");
  }
  for (const CompleterInfo& completer : completers()) {
    const bool of_windows = completer.name == "displaced_surface";
    if (of_windows || !plan.completed.meets(completer.makes | completer.corrects)) continue;
    phrases.push_back("the planes of " + std::string(completer.name));
  }
  if (plan.planes.covers(kBelowPlanes)) {
    phrases.emplace_back("the layer below the water beyond the picture");
  }
  const WaveNormals::Params& waves = plan.look.of<WaveNormals>();
  if (plan.keeps<WaveNormals>() && waves.filter == WaveNormals::Filter::kVariance &&
      (waves.model == WaveNormals::Model::kPlate ||
       (plan.planes.has(PlaneId::kSurfaceDepth) && !plan.completed.has(PlaneId::kSurfaceDepth)))) {
    phrases.emplace_back("waves that the plate's surface does not resolve (wave_normals.filter)");
  }
  if (mirrors_picture(plan, plan.planes, false)) {
    phrases.emplace_back("mirrored surfaces beyond the picture (fresnel_reflection.source)");
  }
  if (plan.keeps<DepthFog>() && !plan.reads_environment && !has_sky &&
      Kernel<DepthFog>::wants_scattered_light(plan.look.of<DepthFog>())) {
    phrases.emplace_back("the light of the visible sky in the water, without [sky] radiance");
  }
  if (plan.keeps<DepthFog>() && Kernel<DepthFog>::wants_scattered_light(plan.look.of<DepthFog>())) {
    phrases.emplace_back("the light of the surroundings in the water");
  }
  if (!plan.made.has(StatePart::kPosition)) return phrases;
  if (plan.look.of<Refraction>().continues_bottom()) {
    phrases.emplace_back("the bottom beyond the picture (refraction.off_frame)");
  }
  if (plan.look.of<Refraction>().uses_bottom_layer()) {
    phrases.emplace_back("the bottom behind objects (refraction.rejection)");
  }
  if (plan.keeps<Caustics>()) phrases.emplace_back("caustics");
  if (plan.keeps<WaterShadow>() && Kernel<WaterShadow>::wants_shafts(plan.look.of<WaterShadow>())) {
    phrases.emplace_back("shafts (water_shadow.shafts)");
  }
  return phrases;
}

void Completer::complete_surface(PlaneSet made, const Pass& pass, Executor& executor,
                                 const std::string* simd, Frame& frame) {
  plate_waves_ = {};
  if (made.empty()) return;
  plate_waves_ = plate_waves_of_sines(pass);
  displaced_surface_.make(frame, pass, executor, simd);
  take(made, PlaneId::kSurfaceDepth, displaced_surface_.depth(), frame);
}

void Completer::complete_sky(PlaneSet made, const Plan& plan, const Pass& pass, Executor& executor,
                             Frame& frame) {
  if (made.empty()) return;
  if (sky_.make(frame, executor)) {
    frame.sky_change = sky_change(frame, pass);
  } else {
    const auto known = known_sky(plan.look.of<FresnelReflection>(), pass);
    sky_.make_even(frame, known ? *known : guessed_sky(frame, pass), executor);
  }
  for (int i = 0; i < 3; ++i) take(made, plane_after(PlaneId::kSkyR, i), sky_.color(i), frame);
}

void Completer::complete_plate_waves(const Plan& plan, PlaneSet own, const Pass& pass,
                                     const Frame& frame) {
  const bool wanted = plan.look.of<WaveNormals>().filter == WaveNormals::Filter::kVariance &&
                      plan.made.has(StatePart::kSlopeVariance);
  const bool tells = own.has(PlaneId::kSurfaceDepth) || own.covers(kSurfaceNormalPlanes);
  if (wanted && tells) plate_waves_ = plate_waves_of(frame, pass);
}

void Completer::complete_waves(const Plan& plan, const Pass& pass, Executor& executor,
                               Frame& frame) {
  const WaveNormals::Params& waves = plan.look.of<WaveNormals>();
  const bool windy = Kernel<WaveNormals>::needs_wave_variance(waves);
  if (!plan.reads_wave_map || !frame.wave_map) return;
  if (waves.filter == WaveNormals::Filter::kNone && !windy) return;
  if (!frame.wave_map.levels) {
    level_maker_.make(frame.wave_map);
    frame.wave_map.levels = &level_maker_.levels();
  }
  if (windy) {
    frame.wave_variance =
        Kernel<WaveNormals>::wave_variance(waves, *frame.wave_map.levels, pass.time);
  }
  if (!Kernel<WaveNormals>::needs_slope_map(waves)) return;
  slope_map_.make(*frame.wave_map.levels, Kernel<WaveNormals>::four_shifts(waves, pass.time),
                  executor);
  frame.wave_slopes = &slope_map_.levels();
}

void Completer::complete_water(const Plan& plan, PlaneSet made, bool pixels, const Pass& pass,
                               Executor& executor, Frame& frame) {
  const DepthFog::Params& water = plan.look.of<DepthFog>();
  if (!Kernel<DepthFog>::wants_scattered_light(water) || !plan.made.has(StatePart::kInScatter))
    return;
  const ScatteringWater scattering = Kernel<DepthFog>::scattering_water(water, pass);
  if (plan.reads_environment && frame.environment) {
    frame.sky_radiance = sky_radiance(frame.environment);
  } else if (pixels && !pass.has_sky) {
    frame.sky_radiance = shown_sky_radiance(frame, pass);
  }
  Rgb<double> sky = frame.sky_radiance.value_or(pass.has_sky ? pass.sky : water.ambient);
  if (pixels) {
    const double closed = closed_share(frame, pass);
    const bool known = frame.sky_radiance || pass.has_sky;
    // A look's ambient is the light in the water as it is; the more closed a room, the more its
    // surfaces tell of the light.
    if (known || closed > 0) {
      const Rgb<double> left = surroundings(frame, pass, sky, closed, executor);
      const double counts = known ? 1 : closed;
      sky = (1 - counts) * sky + counts * left;
      frame.sky_radiance = sky;
    }
  }
  const WaterFloor floor =
      scattering.inside && pixels ? water_floor(frame, pass, sky) : WaterFloor{};
  const ScatteredLights& light = scattered_light_.make(scattering, floor);
  frame.scattered_light = light.data();
  if (made.empty()) return;
  bottom_albedo_.make(frame, pass, sky,
                      {light, Kernel<DepthFog>::extinction(water), scattering.beam}, executor);
  for (int i = 0; i < 3; ++i) {
    const PlaneId plane = plane_after(PlaneId::kAlbedoR, i);
    if (made.has(plane)) frame.planes[index_of(plane)] = bottom_albedo_.channel(i).view();
  }
  if (made.has(PlaneId::kBasin)) {
    frame.planes[index_of(PlaneId::kBasin)] = bottom_albedo_.basin().view();
  }
}

}  // namespace limpid

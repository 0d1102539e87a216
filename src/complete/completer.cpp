#include "complete/completer.h"

#include <string_view>

#include "complete/sky_radiance.h"
#include "ops/depth_fog_kernel.h"
#include "ops/water_shadow_kernel.h"
#include "ops/wave_normals_kernel.h"

namespace limpid {

Frame Completer::complete(const Plan& plan, const Frame& frame, const Pass& pass,
                          Executor& executor, const std::string* simd) {
  Frame whole = frame;
  if (pass.off_centre != glm::dvec2(0, 0)) part_depths_.move(whole, pass, executor);
  if (plan.planes.covers(kBelowPlanes) && frame.present().covers(kBelowPlanes)) {
    below_overscan_.widen(whole, pass, executor);
  }
  // What a completer is to make of a plane that is there is a mended one.
  const auto made_by = [&](std::string_view name) {
    for (const CompleterInfo& completer : completers()) {
      if (completer.name != name || !frame.present().covers(completer.inputs)) continue;
      return plan.completed & ((completer.makes - frame.present()) | completer.mends);
    }
    return PlaneSet{};
  };
  const auto take = [&](PlaneSet made, PlaneId plane, const Plane& with) {
    if (made.has(plane)) whole.planes[index_of(plane)] = with.view();
  };
  if (const PlaneSet made = made_by("displaced_surface"); !made.empty()) {
    displaced_surface_.make(whole, pass, executor, simd);
    take(made, PlaneId::kSurfaceDepth, displaced_surface_.depth());
  }
  if (plan.look.water.edges == Water::Edges::kMixed) edges_.make(whole, pass, executor);
  if (const PlaneSet made = made_by("mirror_depth"); !made.empty()) {
    mirror_depth_.make(whole, pass, executor);
    take(made, PlaneId::kReflectionDepth, mirror_depth_.depth());
    take(made, PlaneId::kReflectionValid, mirror_depth_.valid());
  }
  if (const PlaneSet made = made_by("sky"); !made.empty() && sky_.make(whole, executor)) {
    for (int i = 0; i < 3; ++i) take(made, plane_after(PlaneId::kSkyR, i), sky_.color(i));
  }
  complete_waves(plan, pass, executor, whole);
  complete_water(plan, made_by("bottom_albedo"), pass, executor, whole);
  const Refraction::Params& refraction = plan.look.of<Refraction>();
  if (!plan.made.has(StatePart::kPosition)) return whole;
  if (refraction.goes_on()) whole.continuation = continuation_maker_.make(whole, pass);
  if (refraction.looks_behind()) {
    whole.bottom_layer = bottom_layer_.make(whole, pass, executor);
  }
  const WaterShadow::Params& shade = plan.look.of<WaterShadow>();
  const bool shafts = plan.keeps<WaterShadow>() && Kernel<WaterShadow>::wants_shafts(shade);
  if (plan.keeps<Caustics>() || shafts) {
    Pass now = pass;
    now.planes = whole.present();
    now.wave_variance = whole.wave_variance;
    const DepthFog::Params& water = plan.look.of<DepthFog>();
    const bool scatters = plan.keeps<DepthFog>() && water.model != DepthFog::Model::kLinear;
    const Rgb<double> scattering =
        scatters ? Kernel<DepthFog>::scattering(water) : Rgb<double>{0, 0, 0};
    const WaveNormals::Params& waves = plan.look.of<WaveNormals>();
    light_ = {};
    if (plan.keeps<Caustics>()) {
      light_ = *caustics_.make(waves, scattering, whole, now, executor, simd);
    }
    if (shafts) {
      light_.in_water = shafts_.make(waves, scattering, whole, now, executor, simd,
                                     Kernel<DepthFog>::lit_depth(water, now));
    }
    whole.caustics = &light_;
  }
  return whole;
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

void Completer::complete_water(const Plan& plan, PlaneSet made, const Pass& pass,
                               Executor& executor, Frame& frame) {
  const DepthFog::Params& water = plan.look.of<DepthFog>();
  if (!Kernel<DepthFog>::wants_scattered_light(water) || !plan.made.has(StatePart::kInScatter))
    return;
  frame.scattered_light =
      scattered_light_.make(Kernel<DepthFog>::scattering_water(water, pass)).data();
  if (plan.reads_environment && frame.environment)
    frame.sky_radiance = sky_radiance(frame.environment);
  if (made.empty()) return;
  const Rgb<double> sky = frame.sky_radiance.value_or(pass.has_sky ? pass.sky : water.ambient);
  bottom_albedo_.make(frame, pass, sky, executor);
  for (int i = 0; i < 3; ++i) {
    const PlaneId plane = plane_after(PlaneId::kAlbedoR, i);
    if (made.has(plane)) frame.planes[index_of(plane)] = bottom_albedo_.channel(i).view();
  }
}

}  // namespace limpid

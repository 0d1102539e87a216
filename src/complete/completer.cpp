#include "limpid/complete/completer.h"

namespace limpid {

Frame Completer::complete(const Plan& plan, const Frame& frame, const Context& context,
                          Executor& executor, const std::string* simd) {
  Frame whole = frame;
  const auto lacks = [&](PlaneId plane) {
    return plan.completed.has(plane) && !frame.plane(plane);
  };
  const auto take = [&](PlaneId plane, const Plane& made) {
    if (lacks(plane)) whole.planes[index_of(plane)] = made.view();
  };
  if (lacks(PlaneId::kSurfaceDepth)) {
    displaced_surface_.make(frame, context, executor, simd);
    take(PlaneId::kSurfaceDepth, displaced_surface_.depth());
  }
  if (lacks(PlaneId::kReflectionDepth) || lacks(PlaneId::kReflectionValid)) {
    mirror_depth_.make(frame, context, executor);
    take(PlaneId::kReflectionDepth, mirror_depth_.depth());
    take(PlaneId::kReflectionValid, mirror_depth_.valid());
  }
  if (lacks(PlaneId::kSkyR) && sky_.make(frame, executor)) {
    for (int i = 0; i < 3; ++i) take(plane_after(PlaneId::kSkyR, i), sky_.color(i));
  }
  complete_waves(plan, context, executor, whole);
  return whole;
}

void Completer::complete_waves(const Plan& plan, const Context& context, Executor& executor,
                               Frame& frame) {
  const WaveNormals::Params& waves = plan.look.of<WaveNormals>();
  if (!plan.reads_wave_map || !frame.wave_map || waves.filter == WaveNormals::Filter::kNone) return;
  if (!frame.wave_map.levels) {
    level_maker_.make(frame.wave_map);
    frame.wave_map.levels = &level_maker_.levels();
  }
  if (!WaveNormals::needs_slope_map(waves)) return;
  slope_map_.make(*frame.wave_map.levels, WaveNormals::drift(waves, context.time), executor);
  frame.wave_slopes = &slope_map_.levels();
}

}  // namespace limpid

#include "op/pass.h"

namespace limpid {
namespace {

Bounds bounds_of(const Frame& frame, PlaneSet planes) {
  Rect window;
  for (int i = 0; i < kPlaneCount; ++i) {
    const PlaneId id = static_cast<PlaneId>(i);
    if (!planes.has(id) || !frame.plane(id)) continue;
    window = window.empty() ? frame.plane(id).window : intersection(window, frame.plane(id).window);
  }
  if (window.empty()) window = frame.display;
  const glm::dvec2 corner(frame.display.x0, frame.display.y0);
  const glm::dvec2 size(frame.display.width(), frame.display.height());
  return {(glm::dvec2(window.x0, window.y0) + 0.5 - corner) / size,
          (glm::dvec2(window.x1, window.y1) - 0.5 - corner) / size};
}

bool contains(const Bounds& outer, const Bounds& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

}  // namespace

Swell swell_of(const Frame& frame, Swell swell) {
  swell.raises |= static_cast<bool>(frame.plane(PlaneId::kSurfaceDepth));
  return swell;
}

Pass::Pass(const Scene& scene, const Frame& frame, double index, StateSet parts, const Swell& swell)
    : WaterView(scene, frame.display, swell_of(frame, swell)),
      planes(frame.present()),
      sun(scene.sun.value_or(Sun{})),
      has_sun(scene.sun.has_value()),
      ior(index),
      wave_map(frame.wave_map),
      environment(frame.environment),
      wave_slopes(frame.wave_slopes),
      wave_variance(frame.wave_variance),
      scattered_light(frame.scattered_light),
      sky_change(frame.sky_change),
      made(parts),
      edge_surfaces(frame.edge_surfaces),
      continuation(frame.continuation),
      bottom_layer(frame.bottom_layer),
      caustics(frame.caustics) {
  has_sky = frame.sky_radiance || scene.sky;
  sky = frame.sky_radiance.value_or(scene.sky.value_or(SkyLight{}).radiance);
  dry = bounds_of(frame, kColorPlanes | PlaneSet{PlaneId::kDepth});
  below = bounds_of(frame, kBelowPlanes);
  reflection = bounds_of(
      frame, kReflectionPlanes | PlaneSet{PlaneId::kReflectionValid, PlaneId::kReflectionDepth});
  surface = planes.has(PlaneId::kSurfaceDepth) ? bounds_of(frame, {PlaneId::kSurfaceDepth}) : dry;
  const bool layer = planes.covers(kBelowPlanes);
  surface_ends = !contains(surface, dry) || (layer && !contains(surface, below));
}

}  // namespace limpid

#include "plate/plate_deep.h"

#include <algorithm>
#include <cmath>

#include "limpid/core/error.h"
#include "limpid/files/exr/deep.h"

#include "op/pass.h"

namespace limpid {
namespace {

/// Where the layer below begins, in the depth kind of the samples.
Plane beginning_of_below(const Scene& scene, const DepthMeaning& depth, const Frame& frame,
                         const Rect& window) {
  const WaterView view(scene, frame.display, swell_of(frame));
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  Plane plane(window);
  for (int y = window.y0; y < window.y1; ++y) {
    const RowRays<double> rays(view, y - view.corner.y + 0.5);
    for (int x = window.x0; x < window.x1; ++x) {
      const double pixel_x = x - view.corner.x + 0.5;
      double z = HUGE_VAL;
      if (begins_in_water(view, rays, pixel_x) > 0) {
        z = -HUGE_VAL;
      } else if (!surface) {
        z = rays.calm_depth(pixel_x);
      } else if (surface.window.contains({x, y, x + 1, y + 1})) {
        z = surface.at(x, y);
      }
      if (depth.kind == DepthKind::kRay) z *= length(rays.ray_at(pixel_x));
      plane.view().at(x, y) = static_cast<float>(z);
    }
  }
  return plane;
}

}  // namespace

std::string_view deep_channel(PlaneId plane) {
  switch (plane) {
    case PlaneId::kColorR:
    case PlaneId::kBelowR:
      return "R";
    case PlaneId::kColorG:
    case PlaneId::kBelowG:
      return "G";
    case PlaneId::kColorB:
    case PlaneId::kBelowB:
      return "B";
    case PlaneId::kColorA:
      return "A";
    case PlaneId::kDepth:
    case PlaneId::kBelowDepth:
      return "Z";
    default:
      return "";
  }
}

void read_deep_planes(const ExrFile& file, int part, PlaneSet planes, const Rect& window,
                      const Scene& scene, const DepthMeaning& depth, LoadedPlate& loaded) {
  if (depth.kind != DepthKind::kEye && depth.kind != DepthKind::kRay) {
    throw Error(
        file.path().string() +
        ": holds deep samples: expected depth of kind eye or ray, in which a volume can be split");
  }
  Plane below;
  View<const float> surface{nullptr, 1, 0, window};
  if (planes.meets(kBelowPlanes)) {
    below = beginning_of_below(scene, depth, loaded.frame, window);
    surface = below.view();
  }
  DeepLayers layers = read_deep_layers(file, part, surface);
  loaded.replaced += layers.replaced;

  const auto keep = [&](PlaneId id, Plane& plane) {
    if (!planes.has(id)) return;
    Plane& kept = loaded.planes[static_cast<std::size_t>(index_of(id))] = std::move(plane);
    loaded.frame.planes[static_cast<std::size_t>(index_of(id))] = kept.view();
  };
  for (int c = 0; c < 4; ++c) keep(plane_after(PlaneId::kColorR, c), layers.color[c]);
  for (int c = 0; c < 3; ++c) keep(plane_after(PlaneId::kBelowR, c), layers.below_color[c]);
  const DepthSource source{depth.kind,
                           false,
                           depth.near,
                           depth.far,
                           scene.camera ? &*scene.camera : nullptr,
                           loaded.frame.display,
                           depth.nothing};
  for (Plane* plane : {&layers.depth, &layers.below_depth}) make_eye_depth(plane->view(), source);
  if (surface) {
    for (std::size_t c = 0; c < 4; ++c) {
      loaded.foreground[c] = std::move(layers.foreground[c]);
      loaded.frame.foreground[c] = loaded.foreground[c].view();
    }
  }
  loaded.transparent = std::max(loaded.transparent, layers.transparent);
  keep(PlaneId::kDepth, layers.depth);
  keep(PlaneId::kBelowDepth, layers.below_depth);
}

}  // namespace limpid

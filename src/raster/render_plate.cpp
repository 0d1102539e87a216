#include "limpid/raster/render_plate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"
#include "limpid/raster/rasterise.h"

#include "complete/displaced_surface.h"
#include "raster/check_rendered.h"
#include "raster/mirror.h"
#include "raster/shadow_map.h"
#include "raster/water_surface.h"

namespace limpid {
namespace {

// The planes of each pass.
const PlaneSet kDryPlanes =
    kColorPlanes | PlaneSet{PlaneId::kColorA, PlaneId::kDepth, PlaneId::kShadow};
const PlaneSet kMirrorPlanes =
    kReflectionPlanes | PlaneSet{PlaneId::kReflectionValid, PlaneId::kReflectionDepth};
const PlaneSet kBelowColorPlanes = kBelowPlanes - PlaneSet{PlaneId::kBelowDepth};
const PlaneSet kSurfacePlanes =
    kSurfaceNormalPlanes | PlaneSet{PlaneId::kSurfaceDepth, PlaneId::kSurfaceShadow};

/// Renders one plate: the data that its passes share.
class PlateRenderer {
 public:
  PlateRenderer(const Model& model, const Scene& scene, const RenderOptions& options,
                PlaneSet wanted, Executor& executor)
      : model_(model),
        scene_(scene),
        options_(options),
        executor_(executor),
        display_(rect_of(options.size)),
        window_{-options.overscan, -options.overscan, display_.x1 + options.overscan,
                display_.y1 + options.overscan},
        rasteriser_(model) {
    plate_.frame.display = display_;
    plate_.planes.resize(kPlaneCount);
    lighting_.sun = scene.sun.value_or(Sun{{0, 1, 0}, {0, 0, 0}});
    const PlaneSet sunlit = kColorPlanes | kReflectionPlanes | kBelowColorPlanes | kSunColorPlanes |
                            PlaneSet{PlaneId::kShadow, PlaneId::kSurfaceShadow};
    if (scene.sun && !(wanted & sunlit).empty()) {
      shadow_map_ = make_shadow_map(model, *scene.sun, std::nullopt, options.shadow_map_size,
                                    executor, options.simd);
      lighting_.shadow = &shadow_map_;
    }
  }

  void draw_dry(PlaneSet wanted) {
    RasterWanted planes;
    planes.color = !(wanted & kColorPlanes).empty();
    planes.coverage = wanted.has(PlaneId::kColorA);
    planes.depth = wanted.has(PlaneId::kDepth);
    planes.shadow = wanted.has(PlaneId::kShadow);
    RasterImage image = draw(*scene_.camera, planes);
    keep_color(PlaneId::kColorR, image);
    if (planes.coverage) {  // the background belongs to the picture: opaque everywhere
      fill(image.coverage, 1);
      keep(PlaneId::kColorA, std::move(image.coverage));
    }
    if (planes.depth) keep(PlaneId::kDepth, std::move(image.depth));
    if (planes.shadow) keep(PlaneId::kShadow, std::move(image.shadow));
  }

  /// With the shading of the dry picture, which is therefore never darker.
  void draw_sunlight() {
    lighting_.sun_alone = true;
    RasterImage image = draw(*scene_.camera, {.color = true});
    lighting_.sun_alone = false;
    keep_color(PlaneId::kSunColorR, image);
  }

  void draw_reflection(PlaneSet wanted) {
    const bool valid = wanted.has(PlaneId::kReflectionValid);
    const bool depth = wanted.has(PlaneId::kReflectionDepth);
    const Camera mirrored = mirrored_camera(*scene_.camera, *scene_.water);
    const RasterWanted planes{.color = wanted.meets(kReflectionPlanes), .depth = valid || depth};
    RasterImage image = draw(mirrored, planes, std::nullopt, true);
    keep_color(PlaneId::kReflectionR, image);
    if (valid) {
      // Where a back face comes first, the mirror shows the inside of an object clipped at the
      // water.
      const RasterImage open = draw(mirrored, {.depth = true}, std::nullopt, true, false);
      Plane mask(window_);
      for_each_pixel([&](int x, int y) {
        const float front = image.depth.view().at(x, y), any = open.depth.view().at(x, y);
        mask.view().at(x, y) = any < front ? 0.0f : 1.0f;
      });
      keep(PlaneId::kReflectionValid, std::move(mask));
    }
    if (depth) keep(PlaneId::kReflectionDepth, std::move(image.depth));
  }

  /// Waves may raise the water above the calm plane: so the layer is clipped at their crest, and
  /// each lookup tests whether the surface lies in front.
  void draw_below(PlaneSet wanted) {
    const WaterPlane& water = *scene_.water;
    const RasterWanted planes{.color = wanted.meets(kBelowColorPlanes),
                              .depth = wanted.has(PlaneId::kBelowDepth)};
    const glm::dvec4 under(-water.up, water.height + highest_crest(water));
    RasterImage image = draw(*scene_.camera, planes, under);
    keep_color(PlaneId::kBelowR, image);
    if (planes.depth) keep(PlaneId::kBelowDepth, std::move(image.depth));
  }

  void draw_surface(PlaneSet wanted) {
    const Camera& camera = *scene_.camera;
    const WaterPlane& water = *scene_.water;
    const bool shadow = wanted.has(PlaneId::kSurfaceShadow);
    const Model model = raised_water(model_, water, scene_.time);
    const bool has_mesh = !model.instances.empty();
    SeenSurface surface;
    if (has_mesh) {
      RasterImage image;
      Rasteriser(model).draw({camera, display_, window_, RasterSubject::kWater}, lighting_,
                             {.depth = true}, executor_, image, options_.simd);
      surface.depth = std::move(image.depth);
      if (scene_.has_waves() && is_level(model_, water)) raise_to_waves(surface.depth);
      if (shadow || wanted.meets(kSurfaceNormalPlanes)) {
        surface.normal =
            surface_normals(surface.depth, camera, water, scene_.time, display_, executor_);
      }
    } else if (shadow) {
      surface = calm_surface(camera, water, display_, window_);
    }
    if (shadow && lighting_.shadow) {
      keep(PlaneId::kSurfaceShadow,
           surface_shadow(surface, camera, water, display_, shadow_map_, executor_));
    }
    if (!has_mesh) return;  // the chain computes the calm plane itself
    if (wanted.has(PlaneId::kSurfaceDepth)) keep(PlaneId::kSurfaceDepth, std::move(surface.depth));
    if (!wanted.meets(kSurfaceNormalPlanes)) return;
    for (int c = 0; c < 3; ++c) {
      keep(plane_after(PlaneId::kSurfaceNormalX, c),
           std::move(surface.normal[static_cast<std::size_t>(c)]));
    }
  }

  RenderedPlate finished() && { return std::move(plate_); }

 private:
  RasterImage draw(const Camera& camera, RasterWanted wanted,
                   std::optional<glm::dvec4> clip_plane = {}, bool flip = false, bool cull = true) {
    RasterImage image;
    rasteriser_.draw({camera, display_, window_, RasterSubject::kDry, clip_plane, flip, cull},
                     lighting_, wanted, executor_, image, options_.simd);
    return image;
  }

  /// A mesh is flat between its vertices, which may be too far apart for its waves. So it tells
  /// where there is water, and the waves tell how far away.
  void raise_to_waves(Plane& depth) const {
    Frame frame;
    frame.planes[static_cast<std::size_t>(index_of(PlaneId::kDepth))] = depth.view();
    const WaterView view(scene_, display_, {.raises = true, .waves = scene_.water->waves});
    DisplacedSurface waves;
    waves.make(frame, view, executor_, &options_.simd);
    run_each(executor_, window_.height(), [&](int row) {
      const int y = window_.y0 + row;
      for (int x = window_.x0; x < window_.x1; ++x) {
        float& mesh = depth.view().at(x, y);
        const float met = waves.depth().view().at(x, y);
        if (std::isfinite(mesh) && std::isfinite(met)) mesh = met;
      }
    });
  }

  void keep(PlaneId id, Plane plane) {
    Plane& slot = plate_.planes[static_cast<std::size_t>(index_of(id))];
    slot = std::move(plane);
    plate_.frame.planes[static_cast<std::size_t>(index_of(id))] = slot.view();
  }
  void keep_color(PlaneId first, RasterImage& image) {
    for (int c = 0; c < 3; ++c) {
      if (image.color[c]) keep(plane_after(first, c), std::move(image.color[c]));
    }
  }

  template <class Fn>
  void for_each_pixel(Fn&& fn) const {
    for (int y = window_.y0; y < window_.y1; ++y) {
      for (int x = window_.x0; x < window_.x1; ++x) fn(x, y);
    }
  }
  void fill(Plane& plane, float value) const {
    for_each_pixel([&](int x, int y) { plane.view().at(x, y) = value; });
  }

  const Model& model_;
  const Scene& scene_;
  const RenderOptions& options_;
  Executor& executor_;
  Rect display_, window_;
  Rasteriser rasteriser_;
  ShadowMap shadow_map_;
  RasterLighting lighting_;
  RenderedPlate plate_;
};

}  // namespace

PlaneSet renderable(const Model& model, const Scene& scene) {
  if (!scene.water)
    throw Error("no water plane found: expected a scene with [water] up and height");
  PlaneSet planes = kColorPlanes | kBelowPlanes | PlaneSet{PlaneId::kColorA, PlaneId::kDepth};
  if (scene.sun) {
    planes = planes | kSunColorPlanes | PlaneSet{PlaneId::kShadow, PlaneId::kSurfaceShadow};
  }
  if (scene.camera && sees_mirror(*scene.camera, *scene.water)) {
    planes =
        planes | kReflectionPlanes | PlaneSet{PlaneId::kReflectionValid, PlaneId::kReflectionDepth};
  }
  const bool water = std::any_of(model.instances.begin(), model.instances.end(),
                                 [](const Instance& i) { return i.water; });
  if (water) planes = planes | PlaneSet{PlaneId::kSurfaceDepth};
  if (!water && !scene.water->waves.empty()) {
    throw Error("water.waves move a mesh, and the geometry has no node with water = true");
  }
  // A calm mesh adds nothing to the plane; its normals would only replace other normals.
  if (water && !scene.water->waves.empty()) planes = planes | kSurfaceNormalPlanes;
  return planes;
}

RenderedPlate render_plate(const Model& model, const Scene& scene, const RenderOptions& options,
                           PlaneSet wanted, Executor& executor) {
  check_rendered(scene, options.size, options.overscan);
  if (!sees_mirror(*scene.camera, *scene.water)) wanted = wanted - kMirrorPlanes;
  PlateRenderer renderer(model, scene, options, wanted, executor);
  if (wanted.meets(kDryPlanes)) renderer.draw_dry(wanted);
  if (wanted.meets(kSunColorPlanes) && scene.sun) renderer.draw_sunlight();
  if (wanted.meets(kMirrorPlanes)) renderer.draw_reflection(wanted);
  if (wanted.meets(kBelowPlanes)) renderer.draw_below(wanted);
  if (wanted.meets(kSurfacePlanes)) renderer.draw_surface(wanted);
  return std::move(renderer).finished();
}

Scene scene_of_model(const Scene& scene, const Model& model, Size size) {
  Scene whole = scene;
  if (!whole.camera && model.camera) {
    whole.camera = model.camera;
    glm::dmat4& p = whole.camera->projection;
    p[0][0] = p[1][1] * size.height / std::max(1, size.width);
  }
  if (!whole.sun) whole.sun = model.sun;
  return whole;
}

}  // namespace limpid

#include "limpid/raster/render_plate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"
#include "limpid/optics/waves.h"
#include "limpid/raster/mirror.h"
#include "limpid/raster/rasterise.h"
#include "limpid/raster/shadow_map.h"

namespace limpid {
namespace {

/// The water of a model as it stands at one time: its meshes in world space, every vertex raised by
/// the waves, with the true normals of the raised surface.
Model raised_water(const Model& model, const WaterPlane& water, double time) {
  const PlaneAxes axes = plane_axes(water.up);
  Model raised;
  raised.materials.emplace_back();
  raised.materials[0].double_sided = true;
  for (const Instance& instance : model.instances) {
    if (!instance.water) continue;
    Mesh mesh = model.meshes[static_cast<std::size_t>(instance.mesh)];
    mesh.material = 0;
    mesh.uvs.clear();
    mesh.normals.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::dvec3 p(instance.world_from_mesh * glm::dvec4(mesh.positions[i], 1));
      const WaveHeight wave =
          wave_height(water.waves, glm::dot(p, axes.x), glm::dot(p, axes.y), time);
      mesh.positions[i] = glm::vec3(p + wave.height * water.up);
      mesh.normals[i] =
          glm::vec3(glm::normalize(water.up - wave.slope_x * axes.x - wave.slope_y * axes.y));
    }
    // Whichever way the mesh was wound, its front is the side that the viewer above looks at.
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const glm::dvec3 a(mesh.positions[mesh.indices[t]]), b(mesh.positions[mesh.indices[t + 1]]),
          c(mesh.positions[mesh.indices[t + 2]]);
      if (glm::dot(glm::cross(b - a, c - a), water.up) < 0) {
        std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
      }
    }
    raised.instances.push_back({static_cast<int>(raised.meshes.size()), glm::dmat4(1.0), true});
    raised.meshes.push_back(std::move(mesh));
  }
  return raised;
}

/// One plate in the making: what all its passes share.
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
    plate_.extras.resize(kExtraPlaneCount);
    lighting_.sun = scene.sun.value_or(Sun{{0, 1, 0}, {0, 0, 0}});
    const PlaneSet sunlit = kColorPlanes | kReflectionPlanes | PlaneSet{PlaneId::kShadow};
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
    if (planes.coverage) {  // the background is part of the picture: opaque everywhere
      fill(image.coverage, 1);
      keep(PlaneId::kColorA, std::move(image.coverage));
    }
    if (planes.depth) keep(PlaneId::kDepth, std::move(image.depth));
    if (planes.shadow) keep(PlaneId::kShadow, std::move(image.shadow));
  }

  void draw_reflection(bool extras) {
    const Camera mirrored = mirrored_camera(*scene_.camera, *scene_.water);
    RasterImage image = draw(mirrored, {.color = true, .depth = extras}, std::nullopt, true);
    keep_color(PlaneId::kReflectionR, image);
    if (!extras) return;
    // Where a back face comes first, the mirror looks into a solid that the water cut open.
    const RasterImage open = draw(mirrored, {.depth = true}, std::nullopt, true, false);
    Plane valid(window_);
    for_each_pixel([&](int x, int y) {
      const float front = image.depth.view().at(x, y), any = open.depth.view().at(x, y);
      valid.view().at(x, y) = any < front ? 0.0f : 1.0f;
    });
    keep(ExtraPlane::kReflectionValid, std::move(valid));
    keep(ExtraPlane::kReflectionDepth, std::move(image.depth));
  }

  void draw_below() {
    const WaterPlane& water = *scene_.water;
    RasterImage image =
        draw(*scene_.camera, {.color = true, .depth = true}, glm::dvec4(-water.up, water.height));
    for (int c = 0; c < 3; ++c) {
      keep(static_cast<ExtraPlane>(static_cast<int>(ExtraPlane::kBelowR) + c),
           std::move(image.color[c]));
    }
    keep(ExtraPlane::kBelowDepth, std::move(image.depth));
  }

  void draw_surface(bool normals) {
    const Model water = raised_water(model_, *scene_.water, scene_.time);
    if (water.instances.empty()) return;  // the chain derives the calm plane itself
    Rasteriser rasteriser(water);
    RasterImage image;
    rasteriser.draw({*scene_.camera, display_, window_, RasterSubject::kWater}, lighting_,
                    {.depth = true, .normal = normals}, executor_, image, options_.simd);
    if (normals) {
      for (int c = 0; c < 3; ++c) {
        keep(plane_after(PlaneId::kSurfaceNormalX, c), std::move(image.normal[c]));
      }
    }
    keep(PlaneId::kSurfaceDepth, std::move(image.depth));
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

  void keep(PlaneId id, Plane plane) {
    Plane& slot = plate_.planes[static_cast<std::size_t>(index_of(id))];
    slot = std::move(plane);
    plate_.frame.planes[static_cast<std::size_t>(index_of(id))] = slot.view();
  }
  void keep(ExtraPlane id, Plane plane) {
    plate_.extras[static_cast<std::size_t>(id)] = std::move(plane);
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

constexpr std::int64_t kMostPixels = std::int64_t{1} << 27;

void check(const Scene& scene, const RenderOptions& options) {
  scene.validate();
  if (!scene.camera) {
    throw Error("the scene has no camera: expected one in the scene file or in the geometry");
  }
  if (!scene.water) throw Error("the scene has no water plane, expected its normal and height");
  double crest = scene.water->height;
  for (const SineWave& wave : scene.water->waves) crest += std::abs(wave.amplitude);
  const double above = glm::dot(scene.water->up, scene.camera->eye()) - crest;
  if (!(above > 0)) {
    throw Error("the camera is in the water, " + std::to_string(-above) +
                " below its highest crest: expected an eye above it");
  }
  const Size size = options.size;
  if (size.width < 1 || size.height < 1 || size.width > 32000 || size.height > 32000) {
    throw Error("size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                ": expected 1 ... 32000 pixels a side");
  }
  const int limit = (32000 - std::max(size.width, size.height)) / 2;
  if (options.overscan < 0 || options.overscan > limit) {
    throw Error("overscan " + std::to_string(options.overscan) + ": expected 0 ... " +
                std::to_string(limit) + " pixels");
  }
  const std::int64_t pixels = (std::int64_t{size.width} + 2 * options.overscan) *
                              (std::int64_t{size.height} + 2 * options.overscan);
  if (pixels > kMostPixels) {
    throw Error(std::to_string(pixels) + " pixels with overscan and samples: expected at most " +
                std::to_string(kMostPixels) + ", about 10 GB of buffers");
  }
  if (scene.sun && glm::dot(scene.sun->direction, scene.water->up) <= 0) {
    throw Error("the sun is below the horizon: expected a direction that points above the water");
  }
}

}  // namespace

RenderedPlate render_plate(const Model& model, const Scene& scene, const RenderOptions& options,
                           PlaneSet wanted, bool extras, Executor& executor) {
  check(scene, options);
  PlateRenderer renderer(model, scene, options, wanted, executor);
  const PlaneSet dry = kColorPlanes | PlaneSet{PlaneId::kColorA, PlaneId::kDepth, PlaneId::kShadow};
  renderer.draw_dry(wanted & dry);
  if (!(wanted & kReflectionPlanes).empty()) renderer.draw_reflection(extras);
  if (extras) renderer.draw_below();
  const bool normals = !(wanted & kSurfaceNormalPlanes).empty();
  if (normals || wanted.has(PlaneId::kSurfaceDepth)) renderer.draw_surface(normals);
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

#include "judge/trace/surface.h"

#include <algorithm>

#include "judge/trace/finer_water.h"
#include "judge/trace/one_pixel.h"
#include "ops/wave_normals_kernel.h"
#include "raster/water_surface.h"

namespace limpid::trace {
namespace {

bool makes_waves(const WaveNormals::Params& waves, const Texture& wave_map) {
  return waves.strength != 0 && (wave_map || !Kernel<WaveNormals>::needs(waves).wave_map);
}

/// A ray meets a point of the waves: it has no footprint to filter them.
WaveNormals::Params unfiltered(WaveNormals::Params waves) {
  waves.filter = WaveNormals::Filter::kNone;
  return waves;
}

/// The raised water, its grid finer where the waves need it: a model's own grid may be too wide for
/// its waves.
Model fine_water(const Model& model, const Scene& scene) {
  const WaterPlane& water = *scene.water;
  if (water.waves.empty()) return raised_water(model, water, scene.time);
  FinerWater how;
  how.eye = scene.camera->eye();
  how.shortest_wave = shortest_wave(water.waves);
  const WaterPlane calm{water.up, water.height, {}};
  return raised_water(with_finer_water(raised_water(model, calm, scene.time), how).model, water,
                      scene.time);
}

}  // namespace

Surface::Surface(const Model& model, const Scene& scene, const Look& look, const Texture& wave_map,
                 const Pass& pass)
    : pass_(pass),
      water_(*scene.water),
      axes_(plane_axes(scene.water->up)),
      time_(scene.time),
      waves_(unfiltered(look.of<WaveNormals>())),
      wavy_(makes_waves(waves_, wave_map)),
      has_mesh_(std::any_of(model.instances.begin(), model.instances.end(),
                            [](const Instance& i) { return i.water; })),
      raised_(has_mesh_ && !scene.water->waves.empty()),
      height_(-pass.eye_above),
      crest_(raised_ ? highest_crest(*scene.water) : 0),
      mesh_(made(fine_water(model, scene))) {}

Triangles Surface::made(const Model& water) {
  std::vector<Triangles::Part> parts;
  for (const Mesh& mesh : water.meshes) {
    Triangles::Part part;
    for (const glm::vec3& p : mesh.positions) {
      part.positions.push_back(glm::dvec3(p) - pass_.eye);
    }
    part.indices = with_area(part.positions, mesh.indices);
    if (part.indices.empty()) continue;
    parts.push_back(std::move(part));
  }
  return Triangles(std::move(parts));
}

std::optional<SurfacePoint> Surface::nearest(const Ray& ray, bool from_air) const {
  SurfacePoint found;
  if (has_mesh_) {
    const auto hit = mesh_.nearest(ray, from_air ? Sides::kFront : Sides::kBack);
    if (!hit) return std::nullopt;
    found = {hit->distance, hit->point, hit->front, {}};
    found.normal =
        raised_ ? wave_normal(water_, axes_, hit->point + pass_.eye, time_) : normal_at(hit->point);
  } else {
    const double sinks = -glm::dot(ray.direction, pass_.up);
    if (!(from_air ? sinks > 0 : sinks < 0)) return std::nullopt;
    found.distance = (glm::dot(ray.origin, pass_.up) - height_) / sinks;
    if (!(found.distance >= ray.from)) return std::nullopt;
    found.point = ray.at(found.distance);
    found.face = pass_.up;
    found.normal = normal_at(found.point);
  }
  if (!(found.distance < ray.to)) return std::nullopt;
  return found;
}

std::optional<SurfacePoint> Surface::from_below(const Ray& ray) const {
  if (const auto found = nearest(ray, false)) return found;
  const double rises = glm::dot(ray.direction, pass_.up);
  if (!has_mesh_ || !(rises > 0)) return std::nullopt;
  SurfacePoint lid;
  lid.distance = std::max((crest() - glm::dot(ray.origin, pass_.up)) / rises, ray.from);
  lid.point = ray.at(lid.distance);
  lid.face = lid.normal = pass_.up;
  if (!(lid.distance < ray.to)) return std::nullopt;
  return lid;
}

glm::dvec3 Surface::normal_at(const glm::dvec3& point) const {
  if (!wavy_) return pass_.up;
  Pixel<double> pixel{};
  pixel.surface_point = formula_of(point);
  pixel.normal = formula_of(pass_.up);
  OnePixel strip(pixel);
  Kernel<WaveNormals>::apply(waves_, pass_, strip);
  return glm_of(pixel.normal);
}

}  // namespace limpid::trace

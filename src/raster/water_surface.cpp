#include "raster/water_surface.h"

#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "optics/waves.h"
#include "raster/shadow_map.h"

namespace limpid {

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
    mesh.normals.clear();
    for (glm::vec3& position : mesh.positions) {
      const glm::dvec3 p(instance.world_from_mesh * glm::dvec4(position, 1));
      const WaveHeight wave =
          wave_height(water.waves, glm::dot(p, axes.x), glm::dot(p, axes.y), time);
      position = glm::vec3(p + wave.height * water.up);
    }
    // For either winding of the mesh, its front becomes the side facing a viewer above.
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

bool is_level(const Model& model, const WaterPlane& water) {
  const double most = 0.01 * highest_crest(water);
  for (const Instance& instance : model.instances) {
    if (!instance.water) continue;
    for (const glm::vec3& position :
         model.meshes[static_cast<std::size_t>(instance.mesh)].positions) {
      const glm::dvec3 p(instance.world_from_mesh * glm::dvec4(position, 1));
      if (std::abs(glm::dot(p, water.up) - water.height) > most) return false;
    }
  }
  return true;
}

glm::dvec3 wave_normal(const WaterPlane& water, const PlaneAxes& axes, const glm::dvec3& point,
                       double time) {
  const WaveHeight wave =
      wave_height(water.waves, glm::dot(point, axes.x), glm::dot(point, axes.y), time);
  return glm::normalize(water.up - wave.slope_x * axes.x - wave.slope_y * axes.y);
}

double highest_crest(const WaterPlane& water) {
  double sum = 0;
  for (const SineWave& wave : water.waves) sum += std::abs(wave.amplitude);
  return sum;
}

std::array<Plane, 3> surface_normals(const Plane& depth, const Camera& camera,
                                     const WaterPlane& water, double time, const Rect& display,
                                     Executor& executor) {
  const View<const float> z = depth.view();
  const Rays rays = rays_of(camera, {display.width(), display.height()});
  const glm::dvec3 eye = camera.eye();
  const PlaneAxes axes = plane_axes(water.up);
  std::array<Plane, 3> normals{Plane(z.window), Plane(z.window), Plane(z.window)};
  run_each(executor, z.window.height(), [&](int row) {
    const int y = z.window.y0 + row;
    for (int x = z.window.x0; x < z.window.x1; ++x) {
      const double far = z.at(x, y), u = x - display.x0 + 0.5, v = y - display.y0 + 0.5;
      if (std::isinf(far)) continue;
      const glm::dvec3 point = eye + rays.origin_at(u, v) + far * rays.ray_at(u, v);
      const glm::dvec3 normal = wave_normal(water, axes, point, time);
      for (int c = 0; c < 3; ++c) {
        normals[static_cast<std::size_t>(c)].view().at(x, y) = static_cast<float>(normal[c]);
      }
    }
  });
  return normals;
}

SeenSurface calm_surface(const Camera& camera, const WaterPlane& water, const Rect& display,
                         const Rect& window) {
  const Rays rays = rays_of(camera, {display.width(), display.height()});
  const double above = glm::dot(water.up, camera.eye()) - water.height;
  SeenSurface surface;
  surface.depth = Plane(window);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const double u = x - display.x0 + 0.5, v = y - display.y0 + 0.5;
      const double over = above + glm::dot(water.up, rays.origin_at(u, v));
      const double depth = -over / glm::dot(water.up, rays.ray_at(u, v));
      surface.depth.view().at(x, y) =
          depth > 0 ? static_cast<float>(depth) : std::numeric_limits<float>::infinity();
    }
  }
  return surface;
}

Plane surface_shadow(const SeenSurface& surface, const Camera& camera, const WaterPlane& water,
                     const Rect& display, const ShadowMap& map, Executor& executor) {
  const View<const float> depth = surface.depth.view();
  const Rays rays = rays_of(camera, {display.width(), display.height()});
  const glm::dvec3 eye = camera.eye();
  Plane shadow(depth.window);
  auto shade_row = [&](int row) {
    const int y = depth.window.y0 + row;
    for (int x = depth.window.x0; x < depth.window.x1; ++x) {
      const double z = depth.at(x, y), u = x - display.x0 + 0.5, v = y - display.y0 + 0.5;
      float& lit = shadow.view().at(x, y);
      lit = 1;
      if (std::isinf(z)) continue;
      const auto n = [&](std::size_t c) { return surface.normal[c].view().at(x, y); };
      const glm::dvec3 normal = surface.normal[0] ? glm::dvec3(n(0), n(1), n(2)) : water.up;
      const glm::dvec3 point = eye + rays.origin_at(u, v) + z * rays.ray_at(u, v);
      lit = static_cast<float>(shadow_at(map, point, normal));
    }
  };
  run_each(executor, depth.window.height(), shade_row);
  return shadow;
}

}  // namespace limpid

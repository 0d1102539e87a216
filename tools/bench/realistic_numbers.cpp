#include "realistic_numbers.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "op/pass.h"

namespace limpid::bench {

RealisticNumbers::RealisticNumbers(const Look& look, const Frame& frame, const Scene& scene) {
  const Pass c(scene, frame, look.water.ior, {});
  size = frame.display.size();
  ray_dx = c.rays.ray_dx;
  ray_dy = c.rays.ray_dy;
  ray = c.rays.ray + 0.5 * (ray_dx + ray_dy);

  const auto& waves = look.of<WaveNormals>();
  const glm::dvec2 eye(glm::dot(c.eye, c.map_x), glm::dot(c.eye, c.map_y));
  const double drift = waves.speed * c.time;
  const glm::dvec2 drifts[] = {{drift, 0}, {-drift, 0}, {0, drift}, {0, -drift}};
  for (int i = 0; i < 4; ++i) map_begin[i] = glm::fract((eye + drifts[i]) / waves.tile_size);
  map_u = c.map_x / waves.tile_size;
  map_v = c.map_y / waves.tile_size;
  // up + strength ((sum / 2 - 1) in the axes of the map - up)
  const glm::dmat3 axes(c.map_x, c.map_y, c.up);
  blend = 0.5 * waves.strength * axes;
  blend_begin = c.up - waves.strength * (axes * glm::dvec3(1) + c.up);
  tilt_x = c.t;
  tilt_y = -c.b;

  const glm::dvec2 pixels(size.width, size.height);
  refract_shift = look.of<Refraction>().strength * pixels;
  prism_shift = look.of<PrismSplit>().strength * pixels;
  mirror_shift = look.of<FresnelReflection>().strength * pixels;
  const auto& fog = look.of<DepthFog>();
  fog_density = fog.density;
  fog_offset = fog.offset;
  fog_alpha = fog.alpha;
  fog_color = {fog.color.r, fog.color.g, fog.color.b};
  shadow_strength = look.of<WaterShadow>().strength;
  rim_power = look.of<FresnelReflection>().power;
  const auto& glint = look.of<SunHighlight>();
  sun_power = glint.power;
  sun_direction = c.sun.direction;
  sun_color = glint.strength * glm::dvec3(c.sun.color.r, c.sun.color.g, c.sun.color.b);
}

}  // namespace limpid::bench

// This file is compiled twice; LIMPID_SCALAR_LOOP is the name of the loop's function.
#include "scalar_loop.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace limpid::bench {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int kBandRows = 16;

int floor_of(float x) {
  const int i = static_cast<int>(x);
  return i - (static_cast<float>(i) > x);
}

float mix(float a, float b, float t) { return a + t * (b - a); }

/// Four texels around a position on the screen, clamped to the picture, for any plane.
struct Taps {
  Taps(float x, float y, Size size) {
    const int left = floor_of(x), top = floor_of(y);
    u = x - static_cast<float>(left);
    v = y - static_cast<float>(top);
    x0 = std::clamp(left, 0, size.width - 1);
    x1 = std::clamp(left + 1, 0, size.width - 1);
    y0 = std::clamp(top, 0, size.height - 1);
    y1 = std::clamp(top + 1, 0, size.height - 1);
  }
  float of(const View<const float>& plane) const {
    const float* upper = plane.data + y0 * plane.y_stride;
    const float* lower = plane.data + y1 * plane.y_stride;
    return mix(mix(upper[x0], upper[x1], u), mix(lower[x0], lower[x1], u), v);
  }
  int x0, x1, y0, y1;
  float u, v;
};

/// All inputs of the loop, in float.
struct Loop {
  explicit Loop(const ScalarJob& job)
      : n(job.numbers),
        map(job.map.data()),
        map_width(job.map_size.width),
        map_height(job.map_size.height),
        ray_dx(n.ray_dx),
        map_u(n.map_u),
        map_v(n.map_v),
        blend(n.blend),
        blend_begin(n.blend_begin),
        tilt_x(n.tilt_x),
        tilt_y(n.tilt_y),
        refract_shift(n.refract_shift),
        prism_shift(n.prism_shift),
        mirror_shift(n.mirror_shift),
        fog_density(static_cast<float>(n.fog_density)),
        fog_offset(static_cast<float>(n.fog_offset)),
        fog_alpha(static_cast<float>(n.fog_alpha)),
        shadow_strength(static_cast<float>(n.shadow_strength)),
        rim_power(static_cast<float>(n.rim_power)),
        sun_power(static_cast<float>(n.sun_power)),
        fog_color(n.fog_color),
        sun_direction(n.sun_direction),
        sun_color(n.sun_color) {
    const auto plane = [&](PlaneId id) { return job.frame.plane(id); };
    depth = plane(PlaneId::kDepth);
    surface = plane(PlaneId::kSurfaceDepth);
    shadow = plane(PlaneId::kShadow);
    for (int c = 0; c < 3; ++c) {
      color[c] = plane(plane_after(PlaneId::kColorR, c));
      mirrored[c] = plane(plane_after(PlaneId::kReflectionR, c));
    }
    for (int i = 0; i < 4; ++i) map_begin[i] = n.map_begin[i];
  }

  vec3 tiled(vec2 periods) const {
    const float x = periods.x * static_cast<float>(map_width) - 0.5f;
    const float y = periods.y * static_cast<float>(map_height) - 0.5f;
    const int left = floor_of(x), top = floor_of(y);
    const float u = x - static_cast<float>(left), v = y - static_cast<float>(top);
    const int x0 = wrap(left, map_width), y0 = wrap(top, map_height);
    const int x1 = x0 + 1 == map_width ? 0 : x0 + 1, y1 = y0 + 1 == map_height ? 0 : y0 + 1;
    const auto texel = [&](int i, int j) { return map + 3 * (j * map_width + i); };
    const float *a = texel(x0, y0), *b = texel(x1, y0), *c = texel(x0, y1), *d = texel(x1, y1);
    vec3 out;
    for (int k = 0; k < 3; ++k) out[k] = mix(mix(a[k], b[k], u), mix(c[k], d[k], u), v);
    return out;
  }
  static int wrap(int i, int count) {
    const int rest = i % count;
    return rest < 0 ? rest + count : rest;
  }

  vec3 wet(int x, int y, const vec3& ray, float water, float dry) const {
    const vec3 view = (-1.0f / glm::length(ray)) * ray;
    const vec3 at = water * ray;
    const vec2 place(glm::dot(at, map_u), glm::dot(at, map_v));
    vec3 sum(0.0f);
    for (const vec2& begin : map_begin) sum += tiled(begin + place);
    const vec3 normal = glm::normalize(blend * sum + blend_begin);
    const vec2 tilt(glm::dot(normal, tilt_x), glm::dot(normal, tilt_y));

    const vec2 own(static_cast<float>(x), static_cast<float>(y));
    vec2 seen = own + refract_shift * tilt, prism = prism_shift * tilt;
    const int column = std::clamp(floor_of(seen.x + 0.5f), 0, n.size.width - 1);
    const int row = std::clamp(floor_of(seen.y + 0.5f), 0, n.size.height - 1);
    float hit = depth.data[row * depth.y_stride + column];
    if (hit < water) {
      seen = own;
      prism = vec2(0.0f);
      hit = dry;
    }
    vec3 under(Taps(seen.x + prism.x, seen.y, n.size).of(color[0]),
               Taps(seen.x + 0.5f * prism.x, seen.y + 0.5f * prism.y, n.size).of(color[1]),
               Taps(seen.x, seen.y + prism.y, n.size).of(color[2]));
    const float distance = std::max(hit - water, 0.0f);
    const float veil = fog_alpha * std::clamp(fog_density * distance - fog_offset, 0.0f, 1.0f);
    under += veil * (fog_color - under);
    under *= 1 - shadow_strength * (1 - Taps(seen.x, seen.y, n.size).of(shadow));

    const vec2 mirror = own + mirror_shift * tilt;
    const Taps taps(mirror.x, mirror.y, n.size);
    const vec3 above(taps.of(mirrored[0]), taps.of(mirrored[1]), taps.of(mirrored[2]));
    const float rim = std::max(1 - std::abs(glm::dot(view, normal)), 0.0f);
    under += std::pow(rim, rim_power) * (above - under);

    const vec3 half = glm::normalize(view + sun_direction);
    const float lobe = std::pow(std::clamp(glm::dot(normal, half), 0.0f, 1.0f), sun_power);
    return under + lobe * shadow.data[y * shadow.y_stride + x] * sun_color;
  }

  void run_row(int y, const Target& target) const {
    const vec3 row_ray(n.ray + double(y) * n.ray_dy);
    for (int x = 0; x < n.size.width; ++x) {
      const float water = surface.data[y * surface.y_stride + x];
      const float dry = depth.data[y * depth.y_stride + x];
      vec3 out;
      if (water < dry) {
        out = wet(x, y, row_ray + static_cast<float>(x) * ray_dx, water, dry);
      } else {
        for (int c = 0; c < 3; ++c) out[c] = color[c].data[y * color[c].y_stride + x];
      }
      for (int c = 0; c < 3; ++c) target.color[c].data[y * target.color[c].y_stride + x] = out[c];
    }
  }

  const RealisticNumbers& n;
  const float* map;
  int map_width, map_height;
  vec3 ray_dx, map_u, map_v;
  glm::mat3 blend;
  vec3 blend_begin, tilt_x, tilt_y;
  vec2 refract_shift, prism_shift, mirror_shift;
  float fog_density, fog_offset, fog_alpha, shadow_strength, rim_power, sun_power;
  vec3 fog_color, sun_direction, sun_color;
  vec2 map_begin[4];
  View<const float> depth, surface, shadow, color[3], mirrored[3];
};

struct Bands {
  const Loop& loop;
  const Target& target;

  static void run(void* context, int index) {
    const Bands& bands = *static_cast<const Bands*>(context);
    const int end = std::min((index + 1) * kBandRows, bands.loop.n.size.height);
    for (int y = index * kBandRows; y < end; ++y) bands.loop.run_row(y, bands.target);
  }
};

}  // namespace

void LIMPID_SCALAR_LOOP(const ScalarJob& job, const Target& target, Executor& executor) {
  const Loop loop(job);
  Bands bands{loop, target};
  executor.run((job.numbers.size.height + kBandRows - 1) / kBandRows, Bands::run, &bands);
}

}  // namespace limpid::bench

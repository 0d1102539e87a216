#pragma once
#include "optics/shading.h"
#include "raster/sample.h"

/// Shades visible triangles into the planes of the picture. For inclusion by raster_target.cpp
/// alone.

namespace limpid::raster::HWY_NAMESPACE {

template <class T>
LIMPID_LANES_INLINE Rgb<Lane> color_of(const T (&c)[3]) {
  return {Lane(c[0]), Lane(c[1]), Lane(c[2])};
}

/// The view of a vector of pixels of one row.
struct Sight {
  Vec3<Lane> ray, origin;

  LIMPID_LANES_INLINE Sight(const ShadeJob& job, int x, int y) {
    const Lane step(hn::Iota(kD, 0.5f));
    const auto at = [&](const double* from, const double* dx, const double* dy) {
      const auto channel = [&](int c) {
        return Lane(from[c] + x * dx[c] + (y + 0.5) * dy[c]) + Lane(dx[c]) * step;
      };
      return Vec3<Lane>{channel(0), channel(1), channel(2)};
    };
    ray = at(job.ray, job.ray_dx, job.ray_dy);
    origin = at(job.origin, job.origin_dx, job.origin_dy);
  }
};

/// The light at a vector of pixels, for any material.
struct Light {
  Vec3<Lane> normal, viewer, sun;
  Lane cosine, shadow;
  Rgb<Lane> color;
};

LIMPID_LANES_INLINE Light light_at(const ShadeJob& job, const Fragment& f, const Sight& sight) {
  Light light;
  light.viewer = normalize_or(Lane(-1) * sight.ray, Vec3<Lane>{Lane(0), Lane(0), Lane(1)});
  const Mask back = {
      hn::RebindMask(kD, hn::Lt(f.material, hn::Zero(kDI)))};  // Triangle::kBack is the sign
  const Vec3<Lane> normal = normalize_or(f.normal, light.viewer);
  light.normal = select(back, Lane(-1) * normal, normal);
  light.sun = {Lane(job.sun_direction[0]), Lane(job.sun_direction[1]), Lane(job.sun_direction[2])};
  light.cosine = dot(light.normal, light.sun);
  light.color = color_of(job.sun_color);
  if (job.shadow.depth) {
    const Vec3<Lane> point = sight.origin + f.depth * sight.ray;
    light.shadow = shadow_of(job.shadow, point, light.normal, light.cosine);
  } else {
    light.shadow = select(light.cosine > Lane(0), Lane(1), Lane(0));
  }
  return light;
}

/// `specular_of()` returns the specular color; called only if it matters.
template <class Specular>
LIMPID_LANES_INLINE Rgb<Lane> lit_by(const MaterialView& m, const Rgb<Lane>& base,
                                     const Light& light, Specular&& specular_of) {
  const Rgb<Lane> ambient = color_of(m.ambient);
  switch (m.shading) {
    case Shading::kFlat:
    case Shading::kTextured:
      return base;
    case Shading::kLambert:
      return lambert_shading(base, ambient, light.cosine, light.shadow, light.color);
    case Shading::kToon:
      return toon_shading(base, ambient, light.cosine, light.shadow, light.color);
    case Shading::kPhong: {
      const Rgb<Lane> specular = specular_of();
      return lambert_shading(base, ambient, light.cosine, light.shadow, light.color) +
             phong_glint(specular, Lane(m.power), light.normal, light.viewer, light.sun,
                         light.shadow, light.color);
    }
  }
  return base;
}

LIMPID_LANES_INLINE Rgb<Lane> shaded(const MaterialView& m, const Fragment& f, const Light& light) {
  Rgb<Lane> base = color_of(m.base);
  if (m.base_texture) base = base * sample(*m.base_texture, f.uv);
  return lit_by(m, base, light, [&]() LIMPID_LANES_LAMBDA {
    const Rgb<Lane> specular = color_of(m.specular);
    return m.specular_texture ? specular * sample(*m.specular_texture, f.uv) : specular;
  });
}

/// Calls visit(material, lanes) for every material of the vector in turn.
template <class Visit>
LIMPID_LANES_INLINE void each_material(const ShadeJob& job, const Fragment& f, Visit&& visit) {
  const VI material =
      hn::And(f.material, hn::Set(kDI, static_cast<std::int32_t>(Triangle::kMaterial)));
  Mask left = f.covered;
  while (any(left)) {
    const auto at = hn::FindFirstTrue(kD, left.m);
    alignas(64) std::int32_t numbers[kLanes];
    hn::Store(material, kDI, numbers);
    const std::int32_t number = numbers[at];
    const Mask same = {hn::RebindMask(kD, hn::Eq(material, hn::Set(kDI, number)))};
    visit(job.materials[number], left && same);
    left = left && !same;
  }
}

LIMPID_LANES_INLINE Rgb<Lane> color_at(const ShadeJob& job, const Fragment& f, const Light& light) {
  Rgb<Lane> color = color_of(job.background);
  each_material(job, f, [&](const MaterialView& m, Mask lanes) LIMPID_LANES_LAMBDA {
    color = select(lanes, shaded(m, f, light), color);
  });
  return color;
}

LIMPID_LANES_INLINE void store(float* plane, std::ptrdiff_t at, Lane value) {
  if (plane) hn::Store(value.v, kD, plane + at);
}

LIMPID_LANES_INLINE void store_nothing(const ShadeJob& job, std::ptrdiff_t at) {
  for (int c = 0; c < 3; ++c) {
    store(job.color[c], at, Lane(job.background[c]));
    store(job.normal[c], at, Lane(0));
  }
  store(job.depth, at, Lane(__builtin_inff()));
  store(job.coverage, at, Lane(0));
  store(job.shadow_out, at, Lane(1));
}

LIMPID_LANES_INLINE void store_depth(const ShadeJob& job, std::ptrdiff_t at, const Fragment& f) {
  store(job.depth, at, select(f.covered, f.depth, Lane(__builtin_inff())));
  store(job.coverage, at, select(f.covered, Lane(1), Lane(0)));
}

LIMPID_LANES_INLINE void store_light(const ShadeJob& job, std::ptrdiff_t at, const Fragment& f,
                                     const Light& light) {
  store(job.shadow_out, at, select(f.covered, light.shadow, Lane(1)));
  store(job.normal[0], at, select(f.covered, light.normal.x, Lane(0)));
  store(job.normal[1], at, select(f.covered, light.normal.y, Lane(0)));
  store(job.normal[2], at, select(f.covered, light.normal.z, Lane(0)));
}

LIMPID_LANES_INLINE void store_color(const ShadeJob& job, std::ptrdiff_t at,
                                     const Rgb<Lane>& color) {
  store(job.color[0], at, color.r);
  store(job.color[1], at, color.g);
  store(job.color[2], at, color.b);
}

/// For plain materials the outputs of the job, for all materials depth and coverage.
template <bool kLit>
void shade_tile(const ShadeJob& job, const Screen& tile, const Visibility& seen) {
  const VI nothing = hn::Set(kDI, static_cast<std::int32_t>(kNothing));
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += kLanes) {
      const std::int32_t* ids = seen.id + (y - tile.y0) * kTileStride + x - tile.x0;
      const std::ptrdiff_t at = (y - job.screen.y0) * job.y_stride + (x - job.screen.x0);
      if (hn::AllTrue(kDI, hn::Eq(hn::Load(kDI, ids), nothing))) {
        store_nothing(job, at);
        continue;
      }
      Fragment f;
      find_fragment<kLit>(job, ids, x, y, f);
      store_depth(job, at, f);
      if constexpr (kLit) {
        const Light light = light_at(job, f, Sight(job, x, y));
        store_light(job, at, f, light);
        if (job.color[0]) store_color(job, at, color_at(job, f, light));
      }
    }
  }
}

}  // namespace limpid::raster::HWY_NAMESPACE

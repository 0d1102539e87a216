#pragma once
#include "raster/shade.h"

/// Materials beyond plain ones: opacity, vertex colors, emission, a second set of uvs, other
/// wrapping. For inclusion by raster_target.cpp alone.

namespace limpid::raster::HWY_NAMESPACE {

/// MoreAttributes of the triangles of one vector of pixels.
struct MoreCorners {
  Lane color[4][3], u[3], v[3];
};

/// Interpolated MoreAttributes of the pixels.
struct More {
  Lane color[4];
  Footprint uv;
};

/// `ids`: at least one is covered; an empty lane gets the attributes of the first.
LIMPID_LANES_INLINE void find_more(const ShadeJob& job, const std::int32_t* ids, MoreCorners& out) {
  alignas(64) float values[6][3][kLanes];
  int first = 0;
  while (ids[first] == static_cast<std::int32_t>(kNothing)) ++first;
  for (int l = 0; l < kLanes; ++l) {
    const bool shown = ids[l] != static_cast<std::int32_t>(kNothing);
    const Triangle& t = triangle_of(job, ids[shown ? l : first]);
    for (int k = 0; k < 3; ++k) {
      const MoreAttributes& more = job.more[t.corner[k]];
      for (int c = 0; c < 4; ++c) values[c][k][l] = more.color[c];
      values[4][k][l] = more.u;
      values[5][k][l] = more.v;
    }
  }
  for (int k = 0; k < 3; ++k) {
    for (int c = 0; c < 4; ++c) out.color[c][k] = Lane(hn::Load(kD, values[c][k]));
    out.u[k] = Lane(hn::Load(kD, values[4][k]));
    out.v[k] = Lane(hn::Load(kD, values[5][k]));
  }
}

/// Without attributes in the job: white, and uvs that no material reads.
LIMPID_LANES_INLINE More more_at(const ShadeJob& job, const Shares& shares,
                                 const MoreCorners& corners) {
  More more;
  for (int c = 0; c < 4; ++c) more.color[c] = job.more ? mixed(shares, corners.color[c]) : Lane(1);
  more.uv = {Lane(0), Lane(0), Lane(0), Lane(0), Lane(0), Lane(0)};
  if (job.more) more.uv = footprint(shares, corners.u, corners.v);
  return more;
}

/// White without a texture.
LIMPID_LANES_INLINE Texel texel_of(const PyramidView* texture, const TextureLookup& lookup,
                                   const Fragment& f, const More& more) {
  if (!texture) return {{Lane(1), Lane(1), Lane(1)}, Lane(1)};
  return sample(*texture, lookup.uv_set == 0 ? f.uv : more.uv, lookup.wrap_u, lookup.wrap_v);
}

LIMPID_LANES_INLINE Lane opacity_of(const MaterialView& m, const Texel& base, const More& more) {
  const Lane opacity = Lane(m.alpha) * base.alpha;
  return min(m.vertex_colors ? opacity * more.color[3] : opacity, Lane(1));
}

struct Seen {
  Rgb<Lane> color;
  Lane opacity;
};

/// The color, and the opacity of a blended material.
LIMPID_LANES_INLINE Seen seen_of(const MaterialView& m, const Fragment& f, const More& more,
                                 const Light& light) {
  const Texel texel = texel_of(m.base_texture, m.base_lookup, f, more);
  Rgb<Lane> base = color_of(m.base) * texel.color;
  if (m.vertex_colors) base = base * Rgb<Lane>{more.color[0], more.color[1], more.color[2]};
  const Rgb<Lane> lit = lit_by(m, base, light, [&]() LIMPID_LANES_LAMBDA {
    return color_of(m.specular) * texel_of(m.specular_texture, m.specular_lookup, f, more).color;
  });
  const Rgb<Lane> emitted =
      color_of(m.emission) * texel_of(m.emissive_texture, m.emissive_lookup, f, more).color;
  return {lit + emitted, opacity_of(m, texel, more)};
}

/// Color and opacity of the pixels (x ... x + kLanes - 1, y), of which at least one is covered; the
/// opaque background where no triangle is.
inline Seen find_seen(const ShadeJob& job, const std::int32_t* ids, int x, int y, Fragment& f,
                      Light& light) {
  Corners in;
  f.covered = find_corners<true>(job, ids, in);
  f.material = in.material;
  f.depth = depth_of(job, in, x, y);
  const Shares shares = shares_of(job, in, x, y, f.covered);
  interpolate(shares, in, f);
  MoreCorners corners;
  if (job.more) find_more(job, ids, corners);
  const More more = more_at(job, shares, corners);
  light = light_at(job, f, Sight(job, x, y));
  Seen seen{color_of(job.background), Lane(1)};
  if (!job.color[0]) return seen;
  each_material(job, f, [&](const MaterialView& m, Mask lanes) LIMPID_LANES_LAMBDA {
    const Seen own = seen_of(m, f, more, light);
    seen.color = select(lanes, own.color, seen.color);
    seen.opacity = select(lanes, own.opacity, seen.opacity);
  });
  return seen;
}

/// Writes the outputs of the job, for all materials.
inline void shade_rich_tile(const ShadeJob& job, const Screen& tile, const Visibility& seen) {
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
      Light light;
      const Seen pixels = find_seen(job, ids, x, y, f, light);
      store_depth(job, at, f);
      store_light(job, at, f, light);
      if (job.color[0]) store_color(job, at, pixels.color);
    }
  }
}

}  // namespace limpid::raster::HWY_NAMESPACE

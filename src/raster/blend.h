#pragma once
#include "raster/tested.h"

/// Blends surfaces over the surfaces behind them, layer by layer from the eye on. For inclusion by
/// raster_target.cpp alone.

namespace limpid::raster::HWY_NAMESPACE {

/// Color of the layers so far, and the share visible through them.
struct alignas(64) Layers {
  float color[3][kTile * kTileStride];
  float left[kTile * kTileStride];
};

LIMPID_LANES_INLINE void clear(Layers& layers) {
  for (int i = 0; i < kTile * kTileStride; i += kLanes) {
    for (int c = 0; c < 3; ++c) hn::Store(hn::Zero(kD), kD, layers.color[c] + i);
    hn::Store(hn::Set(kD, 1.0f), kD, layers.left + i);
  }
}

/// Layers stop below this visible share.
constexpr double kLeastLeft = 1.0 / 4096;

/// False if the layer is empty. A finished pixel has no layer behind it.
inline bool add_layer(const ShadeJob& job, const Screen& tile, Visibility& layer, Layers& layers) {
  const VI nothing = hn::Set(kDI, static_cast<std::int32_t>(kNothing));
  bool some = false;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += kLanes) {
      const int i = (y - tile.y0) * kTileStride + x - tile.x0;
      if (hn::AllTrue(kDI, hn::Eq(hn::Load(kDI, layer.id + i), nothing))) continue;
      some = true;
      Fragment f;
      Light light;
      const Seen seen = find_seen(job, layer.id + i, x, y, f, light);
      const Lane left(hn::Load(kD, layers.left + i));
      const Lane share = select(f.covered, left * seen.opacity, Lane(0));
      const Rgb<Lane> color = share * seen.color;
      const Lane added[3] = {color.r, color.g, color.b};
      for (int c = 0; c < 3; ++c) {
        float* sum = layers.color[c] + i;
        hn::Store((Lane(hn::Load(kD, sum)) + select(f.covered, added[c], Lane(0))).v, kD, sum);
      }
      const Lane rest = left - share;
      hn::Store(rest.v, kD, layers.left + i);
      const Mask done = f.covered && rest < Lane(kLeastLeft);
      hn::BlendedStore(hn::Set(kD, -3e38f), done.m, kD, layer.q + i);
    }
  }
  return some;
}

LIMPID_LANES_INLINE void put_over(const ShadeJob& job, const Screen& tile, const Layers& layers) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += kLanes) {
      const int i = (y - tile.y0) * kTileStride + x - tile.x0;
      const std::ptrdiff_t at = (y - job.screen.y0) * job.y_stride + (x - job.screen.x0);
      const Lane left(hn::Load(kD, layers.left + i));
      for (int c = 0; c < 3; ++c) {
        const Lane behind(hn::Load(kD, job.color[c] + at));
        store(job.color[c], at, Lane(hn::Load(kD, layers.color[c] + i)) + left * behind);
      }
    }
  }
}

/// Blends over the colors of the job, which are those of `solid`.
inline void blend(const ShadeJob& job, const Tile& tile, const Visibility& solid) {
  Visibility found[2];
  Layers layers;
  fill(found[0]);
  for (int i = 0; i < kTile * kTileStride; i += kLanes) {
    hn::Store(hn::Set(kD, 3e38f), kD, found[0].q + i);  // all layers lie behind that
  }
  clear(layers);
  int count = 0;
  for (; count < kBlendedLayers; ++count) {
    const Visibility& before = found[count % 2];
    Visibility& layer = found[1 - count % 2];
    find_layer(job, tile, solid, before, layer);
    if (!add_layer(job, tile.pixels, layer, layers)) break;
  }
  if (count > 0) put_over(job, tile.pixels, layers);
}

}  // namespace limpid::raster::HWY_NAMESPACE

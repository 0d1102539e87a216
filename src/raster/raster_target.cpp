// Compiled once for each instruction set, like run/lanes_target.cpp: all instantiations here live
// in the namespace of the set.
#include "core/target_name.h"
#include "raster/blend.h"
#include "raster/cull_stage.h"
#include "raster/vertex_stage.h"
#include "raster/visibility.h"

namespace limpid::raster::HWY_NAMESPACE {
namespace {

Tile tile_of(const ShadeJob& job, int index) {
  Tile tile{index % job.tiles_across, index / job.tiles_across, job.screen};
  Screen& pixels = tile.pixels;
  pixels.x0 += tile.tx * kTile;
  pixels.y0 += tile.ty * kTile;
  if (pixels.x0 + kTile < pixels.x1) pixels.x1 = pixels.x0 + kTile;
  if (pixels.y0 + kTile < pixels.y1) pixels.y1 = pixels.y0 + kTile;
  return tile;
}

void draw_plain_tile(const ShadeJob& job, const Tile& tile) {
  Visibility seen;
  find_visible(job, tile, seen);
  if (job.lit) {
    shade_tile<true>(job, tile.pixels, seen);
  } else {
    shade_tile<false>(job, tile.pixels, seen);
  }
}

void shade_any(const ShadeJob& job, const Tile& tile, const Visibility& seen) {
  if (job.lit) {
    shade_rich_tile(job, tile.pixels, seen);
  } else {
    shade_tile<false>(job, tile.pixels, seen);
  }
}

/// Only the color, of all materials in the tile.
void draw_blended_colors(const ShadeJob& job, const Tile& tile, const Visibility& unblended) {
  ShadeJob colors = job;
  colors.depth = colors.coverage = colors.shadow_out = nullptr;
  for (float*& normal : colors.normal) normal = nullptr;
  Visibility solid = unblended;
  find_tested(job, tile, job.unblended_groups, job.group_count, &MaterialView::solid_from, solid);
  shade_rich_tile(colors, tile.pixels, solid);
  blend(colors, tile, solid);
}

bool has_blended(const ShadeJob& job, const Tile& tile) {
  for (int g = job.unblended_groups; g < job.group_count; ++g) {
    const int t = place_of(job.groups[g], tile);
    if (t >= 0 && job.groups[g].offsets[t] < job.groups[g].offsets[t + 1]) return true;
  }
  return false;
}

void draw_rich_tile(const ShadeJob& job, const Tile& tile) {
  Visibility seen;
  find_visible(job, tile, seen);
  find_tested(job, tile, job.opaque_groups, job.unblended_groups, &MaterialView::solid_from, seen);
  if (!has_blended(job, tile)) {
    shade_any(job, tile, seen);
    return;
  }
  if (job.color[0]) draw_blended_colors(job, tile, seen);
  ShadeJob others = job;
  for (float*& color : others.color) color = nullptr;
  others.lit = job.shadow_out || job.normal[0];
  if (!others.lit && !job.depth && !job.coverage) return;
  find_tested(job, tile, job.unblended_groups, job.group_count, &MaterialView::blocks_from, seen);
  shade_any(others, tile, seen);
}

void draw_tile(const ShadeJob& job, int index) {
  const Tile tile = tile_of(job, index);
  if (job.plain) {
    draw_plain_tile(job, tile);
  } else {
    draw_rich_tile(job, tile);
  }
}

}  // namespace
}  // namespace limpid::raster::HWY_NAMESPACE

namespace limpid::raster {

extern const RasterTarget LIMPID_OF_TARGET(kRaster_);
const RasterTarget LIMPID_OF_TARGET(kRaster_) = {HWY_NAMESPACE::transform, HWY_NAMESPACE::cull,
                                                 HWY_NAMESPACE::set_up, HWY_NAMESPACE::draw_tile};

}  // namespace limpid::raster

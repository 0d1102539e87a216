// Compiled once for each instruction set, like run/lanes_target.cpp: all that is instantiated here
// lives in the namespace of the set.
#include "raster/cull_stage.h"
#include "raster/shade.h"
#include "raster/vertex_stage.h"
#include "raster/visibility.h"

namespace limpid::raster::HWY_NAMESPACE {
namespace {

void draw_tile(const ShadeJob& job, int index) {
  const int tx = index % job.tiles_across, ty = index / job.tiles_across;
  Screen tile = job.screen;
  tile.x0 += tx * kTile;
  tile.y0 += ty * kTile;
  if (tile.x0 + kTile < tile.x1) tile.x1 = tile.x0 + kTile;
  if (tile.y0 + kTile < tile.y1) tile.y1 = tile.y0 + kTile;
  Visibility seen;
  find_visible(job, tx, ty, tile, seen);
  if (job.lit) {
    shade_tile<true>(job, tile, seen);
  } else {
    shade_tile<false>(job, tile, seen);
  }
}

}  // namespace
}  // namespace limpid::raster::HWY_NAMESPACE

namespace limpid::raster {

#define LIMPID_JOIN_(a, b) a##b
#define LIMPID_JOIN(a, b) LIMPID_JOIN_(a, b)

extern const RasterTarget LIMPID_JOIN(kRaster_, LIMPID_LANES_TARGET);
const RasterTarget LIMPID_JOIN(kRaster_, LIMPID_LANES_TARGET) = {
    HWY_NAMESPACE::transform, HWY_NAMESPACE::cull, HWY_NAMESPACE::set_up, HWY_NAMESPACE::draw_tile};

}  // namespace limpid::raster

#pragma once
#include "limpid/raster/rasterise.h"

namespace limpid::bench {

/// A picture that both rasterisers draw: one mesh, one Phong material with a texture.
struct RasterScene {
  const char* label;
  Model model;
  RasterView view;
  RasterLighting lighting;
};

constexpr int kRasterScenes = 3;

/// 0: 200 000 triangles, 1: two million, 2: 512 large ones. Hills that fill 1080p, seen from above.
RasterScene raster_scene(int index);

}  // namespace limpid::bench

#pragma once
#include <memory>
#include <vector>

#include "raster_scene.h"

namespace limpid::bench {

/// The same pictures by OpenGL on EGL without a surface: Mesa's llvmpipe where there is no GPU.
/// Float color and depth targets, the shading of the material in GLSL.
class GlRasteriser {
 public:
  GlRasteriser();
  ~GlRasteriser();

  void load(const RasterScene& scene);
  void draw();  ///< returns when the picture is there
  /// Red, green, blue and depth planes one after the other, rows from the top.
  std::vector<float> picture() const;
  const char* renderer() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limpid::bench

#pragma once
#include <vector>

#include "gl_process.h"
#include "raster_scene.h"

namespace limpid::bench {

/// The same pictures by OpenGL: float color and depth targets, the shading of the material in GLSL.
/// Needs a GlContext.
class GlRasteriser : public GlDrawing {
 public:
  explicit GlRasteriser(const RasterScene& scene);

  void draw() override;
  std::vector<float> picture() const override;  ///< red, green, blue, depth

 private:
  Size size_;
  int indices_ = 0;
};

}  // namespace limpid::bench

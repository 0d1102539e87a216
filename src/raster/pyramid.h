#pragma once
#include <vector>

#include "limpid/raster/model.h"

#include "raster/raster_job.h"

namespace limpid::raster {

/// A texture with its mip chain, halved (rounded down) until 1x1; each texel is the mean of the
/// area it covers one level up.
class Pyramid {
 public:
  explicit Pyramid(const ModelTexture& texture);
  const PyramidView& view() const { return view_; }

 private:
  std::vector<float> texels_;
  PyramidView view_{};
};

}  // namespace limpid::raster

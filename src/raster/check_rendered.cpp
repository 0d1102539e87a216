#include "raster/check_rendered.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include <glm/geometric.hpp>

#include "limpid/core/error.h"
#include "limpid/raster/render_plate.h"

namespace limpid {
namespace {

constexpr std::int64_t kMaxPixels = std::int64_t{1} << 27;

}  // namespace

void check_rendered(const Scene& scene, Size size, int overscan) {
  scene.validate();
  if (!scene.camera) {
    throw Error("the scene has no camera: expected one in the scene file or in the geometry");
  }
  if (!scene.water) throw Error("the scene has no water plane, expected its normal and height");
  const int longest = std::max(size.width, size.height);
  if (size.width < 1 || size.height < 1 || longest > kMaxRenderedSide) {
    throw Error("size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                    ": expected 1 ... " + std::to_string(kMaxRenderedSide) + " pixels a side",
                Fault::kUsage);
  }
  const int limit = (kMaxRenderedSide - longest) / 2;
  if (overscan < 0 || overscan > limit) {
    throw Error("overscan " + std::to_string(overscan) + ": expected 0 ... " +
                    std::to_string(limit) + " pixels",
                Fault::kUsage);
  }
  const std::int64_t pixels =
      (std::int64_t{size.width} + 2 * overscan) * (std::int64_t{size.height} + 2 * overscan);
  if (pixels > kMaxPixels) {
    throw Error(std::to_string(pixels) + " pixels with overscan and samples: expected at most " +
                    std::to_string(kMaxPixels) + ", about 10 GB of buffers",
                Fault::kUsage);
  }
  if (scene.sun && glm::dot(scene.sun->direction, scene.water->up) <= 0) {
    throw Error("the sun is below the horizon: expected a direction that points above the water");
  }
}

}  // namespace limpid

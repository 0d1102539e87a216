#include "plate/plane_budget.h"

#include <algorithm>

#include "limpid/core/error.h"

namespace limpid {

Rect PlaneBudget::take(const std::string& name, const Rect& data, const Rect& picture) {
  const Rect both{std::min(data.x0, picture.x0), std::min(data.y0, picture.y0),
                  std::max(data.x1, picture.x1), std::max(data.y1, picture.y1)};
  // Corners may lie 2^31 apart.
  const std::int64_t width = std::int64_t{both.x1} - both.x0;
  const std::int64_t height = std::int64_t{both.y1} - both.y0;
  const std::int64_t side = std::max(width, height);
  const bool small = side <= limits_.max_side && width * height <= limits_.max_pixels;
  if (!small) {
    throw Error(name + ": its data window and the picture span " + std::to_string(width) + "x" +
                std::to_string(height) + " pixels: expected sides of at most " +
                std::to_string(limits_.max_side) + " and " + std::to_string(limits_.max_pixels) +
                " pixels");
  }
  bytes_ += both.area() * static_cast<std::int64_t>(sizeof(float));
  if (bytes_ > limits_.max_memory) {
    throw Error(name + ": the planes of the frame need more memory than the limit of " +
                std::to_string(limits_.max_memory) + " bytes");
  }
  return both;
}

}  // namespace limpid

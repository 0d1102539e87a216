#pragma once
#include <functional>
#include <vector>

#include "judge/compare/color_pair.h"

namespace limpid::test {

/// A synthetic color picture of a test.
class ColorPlanes {
 public:
  using Color = std::array<float, 3>;
  ColorPlanes(Rect window, const std::function<Color(int, int)>& color) {
    for (int c = 0; c < 3; ++c) planes_.emplace_back(window);
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        const Color here = color(x, y);
        for (std::size_t c = 0; c < 3; ++c) planes_[c].view().at(x, y) = here[c];
      }
    }
  }
  ColorPlanes(Rect window, Color color) : ColorPlanes(window, [&](int, int) { return color; }) {}

  ColorViews views() const { return {planes_[0].view(), planes_[1].view(), planes_[2].view()}; }
  float& at(int c, int x, int y) { return planes_[static_cast<std::size_t>(c)].view().at(x, y); }

 private:
  std::vector<Plane> planes_;
};

}  // namespace limpid::test

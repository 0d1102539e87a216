#pragma once
#include <array>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/color_space.h"
#include "limpid/core/plane.h"

namespace limpid {

/// Makes red, green and blue of one space those of another, in place; nothing where the two agree.
/// All windows must be equal. A pixel with NaN becomes NaN in all three.
inline void convert_color(const std::array<View<float>, 3>& colors, const Primaries& to,
                          const Primaries& from) {
  if (agree(to, from)) return;
  const glm::mat3 matrix(rgb_from_rgb(to, from));
  const Rect window = colors[0].window;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const glm::vec3 made =
          matrix * glm::vec3(colors[0].at(x, y), colors[1].at(x, y), colors[2].at(x, y));
      for (int c = 0; c < 3; ++c) colors[static_cast<std::size_t>(c)].at(x, y) = made[c];
    }
  }
}

}  // namespace limpid

#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/plane.h"
#include "limpid/files/picture/display.h"
#include "limpid/plan/survey.h"
#include "limpid/run/target.h"

/// Numbers of a picture as colors of a screen.

namespace limpid {

using ShownViews = std::array<View<const float>, 3>;

struct Shown {
  Size size;
  std::vector<std::uint8_t> rgba;  ///< rows from the top, A 255
  /// The values at the ends of the color ramp, or of darkest and brightest for a share; none for
  /// light.
  std::optional<std::array<double, 2>> scale;
};

/// Light, with the same bytes as --preview.
Shown shown_light(const ShownViews& color, const DisplayTransform& display, Executor& executor);

/// Colors already encoded for display, 0 ... 1.
Shown shown_encoded(const ShownViews& color, Executor& executor);

/// By kind: light as light; shares unchanged; lengths on the color ramp, infinite ones black;
/// normals and places as colors.
Shown shown_aov(Aov aov, const std::array<View<float>, 3>& views, const DisplayTransform& display,
                Executor& executor);

/// The light tinted by the survey's cells: dry cells unchanged, opaque water red, open water green,
/// cells that need all operators yellow, and other water blue.
Shown shown_cells(const Survey& survey, const ShownViews& color, const DisplayTransform& display,
                  Executor& executor);

}  // namespace limpid

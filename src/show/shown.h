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

/// How numbers of a picture become colors of a screen.

namespace limpid {

using ShownViews = std::array<View<const float>, 3>;

struct Shown {
  Size size;
  std::vector<std::uint8_t> rgba;  ///< rows from the top, A 255
  /// What the ends of the color ramp stand for, or darkest and brightest of a share; none for
  /// light.
  std::optional<std::array<double, 2>> scale;
};

/// Light, as --preview shows it: its very bytes.
Shown shown_light(const ShownViews& color, const DisplayTransform& display, Executor& executor);

/// What is encoded for display already, 0 ... 1.
Shown shown_encoded(const ShownViews& color, Executor& executor);

/// By what it is: light as light; shares as they are; lengths on the color ramp, infinite ones
/// black; normals and places as colors.
Shown shown_aov(Aov aov, const std::array<View<float>, 3>& views, const DisplayTransform& display,
                Executor& executor);

/// The light with the survey's cells in it: dry ones as they are, opaque water red, open water
/// green, what needs everything yellow, and other water blue.
Shown shown_cells(const Survey& survey, const ShownViews& color, const DisplayTransform& display,
                  Executor& executor);

}  // namespace limpid

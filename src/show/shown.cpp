#include "show/shown.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "files/picture/byte_of.h"
#include "show/by_pixel.h"
#include "show/heat_color.h"

namespace limpid {
namespace {

/// The rows [y0, y1) of a view.
View<const float> rows_of(View<const float> view, int y0, int y1) {
  view.data = view.row(y0);
  view.window = {view.window.x0, y0, view.window.x1, y1};
  return view;
}

/// The ends of the color ramp, from a sample of the finite values: the 1st and the 99th percentile.
std::array<double, 2> length_scale(const View<float>& view) {
  constexpr std::int64_t kLooks = 65536;
  const Rect& w = view.window;
  std::vector<float> values;
  const std::int64_t step = std::max<std::int64_t>(1, w.area() / kLooks);
  for (std::int64_t i = 0; i < w.area(); i += step) {
    const auto x = static_cast<int>(i % w.width()), y = static_cast<int>(i / w.width());
    const float value = view.at(w.x0 + x, w.y0 + y);
    if (std::isfinite(value)) values.push_back(value);
  }
  if (values.empty()) return {0, 1};
  std::sort(values.begin(), values.end());
  const double low = values[values.size() / 100], high = values[values.size() * 99 / 100];
  return {low, high > low ? high : low + 1};
}

Shown shown_length(const View<float>& view, Executor& executor) {
  const std::array<double, 2> scale = length_scale(view);
  Shown shown = by_pixel(view.window, executor, [&](int x, int y) {
    const double value = view.at(x, y);
    return std::isfinite(value) ? heat_color((value - scale[0]) / (scale[1] - scale[0]))
                                : ShownColor{};
  });
  shown.scale = scale;
  return shown;
}

Shown shown_normal(const std::array<View<float>, 3>& n, Executor& executor) {
  Shown shown = by_pixel(n[0].window, executor, [&](int x, int y) {
    const ShownColor v = {n[0].at(x, y), n[1].at(x, y), n[2].at(x, y)};
    if (v == ShownColor{}) return v;  // a dry pixel
    return ShownColor{0.5f + 0.5f * v[0], 0.5f + 0.5f * v[1], 0.5f + 0.5f * v[2]};
  });
  shown.scale = {-1, 1};
  return shown;
}

/// One, two or three channels, unchanged.
Shown shown_share(const std::array<View<float>, 3>& views, Executor& executor) {
  Shown shown = by_pixel(views[0].window, executor, [&](int x, int y) {
    const float first = views[0].at(x, y);
    if (!views[1]) return ShownColor{first, first, first};
    return ShownColor{first, views[1].at(x, y), views[2] ? views[2].at(x, y) : 0};
  });
  shown.scale = {0, 1};
  return shown;
}

/// The color for a cell's operators, and none for a dry cell.
std::optional<ShownColor> cell_color(const CellNeeds& cell) {
  if (cell.dry) return std::nullopt;
  if (cell.opaque) return ShownColor{0.9f, 0.2f, 0.15f};
  if (cell.open) return ShownColor{0.2f, 0.8f, 0.35f};
  if (cell.skips == 0) return ShownColor{0.95f, 0.8f, 0.2f};
  return ShownColor{0.2f, 0.45f, 0.95f};
}

}  // namespace

Shown shown_light(const ShownViews& color, const DisplayTransform& display, Executor& executor) {
  const Rect window = color[0].window;
  return in_bands(window, executor, [&](int y0, int y1, std::uint8_t* to) {
    const std::array<Plane, 3> encoded = display.displayed(
        {rows_of(color[0], y0, y1), rows_of(color[1], y0, y1), rows_of(color[2], y0, y1)});
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint8_t* next = to + c;
      for (int y = y0; y < y1; ++y) {
        const float* const row = encoded[c].view().row(y);
        for (int x = 0; x < window.width(); ++x, next += 4) *next = byte_of(row[x]);
      }
    }
    const int count = window.width() * (y1 - y0);
    for (int i = 0; i < count; ++i) to[4 * i + 3] = 255;
  });
}

Shown shown_encoded(const ShownViews& color, Executor& executor) {
  return by_pixel(color[0].window, executor, [&](int x, int y) {
    return ShownColor{color[0].at(x, y), color[1].at(x, y), color[2].at(x, y)};
  });
}

Shown shown_aov(Aov aov, const std::array<View<float>, 3>& views, const DisplayTransform& display,
                Executor& executor) {
  switch (aov) {
    case Aov::kTransmitted:
    case Aov::kInScatter:
    case Aov::kReflected:
    case Aov::kHighlight:
    case Aov::kSky:
      return shown_light({views[0], views[1], views[2]}, display, executor);
    case Aov::kPath:
    case Aov::kSurfaceDepth:
    case Aov::kReflectionDepth:
      return shown_length(views[0], executor);
    case Aov::kNormal:
      return shown_normal(views, executor);
    case Aov::kFresnel:
    case Aov::kTransmittance:
    case Aov::kConfidence:
    case Aov::kStmapR:
    case Aov::kStmapG:
    case Aov::kStmapB:
    case Aov::kMirrorSources:
    case Aov::kReflectionValid:
    case Aov::kSurfaceShadow:
      break;
  }
  return shown_share(views, executor);
}

Shown shown_cells(const Survey& survey, const ShownViews& color, const DisplayTransform& display,
                  Executor& executor) {
  constexpr float kShare = 0.45f;
  Shown shown = shown_light(color, display, executor);
  const Rect window = color[0].window;
  run_each(executor, window.height(), [&](int row) {
    std::uint8_t* to = shown.rgba.data() + std::size_t{4} * row * window.width();
    for (int x = window.x0; x < window.x1; ++x, to += 4) {
      const std::optional<ShownColor> tint = cell_color(survey.at(x, window.y0 + row));
      if (!tint) continue;
      for (int c = 0; c < 3; ++c) {
        to[c] = byte_of(std::lerp(static_cast<float>(to[c]) / 255, (*tint)[c], kShare));
      }
    }
  });
  return shown;
}

}  // namespace limpid

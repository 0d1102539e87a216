#include "enter/nothing_hit.h"

#include <limits>

namespace limpid {
namespace {

/// The value of a plane where nothing was hit.
float nothing_value(const DepthSource& source) {
  switch (source.kind) {
    case DepthKind::kEye:
    case DepthKind::kRay:
      break;
    case DepthKind::kInverse:
      return 0;
    case DepthKind::kNormalised:
      return 1;
    case DepthKind::kDevice:
      return source.camera && source.camera->clip == ClipSpace::kReversed ? 0.0f : 1.0f;
  }
  return std::numeric_limits<float>::infinity();
}

}  // namespace

bool row_has(float value, const float* row, std::ptrdiff_t stride, int count) {
  int has = 0;  // without a branch, so that compilers vectorise it
  if (stride == 1) {
    for (int i = 0; i < count; ++i) has |= static_cast<int>(row[i] == value);
  } else {
    for (int i = 0; i < count; ++i) has |= static_cast<int>(row[i * stride] == value);
  }
  return has != 0;
}

void mark_nothing_hit(const View<float>& plane, const DepthSource& source) {
  if (!source.nothing && !source.uncovered) return;
  const float nothing = nothing_value(source);
  const float asked = static_cast<float>(source.nothing.value_or(0));
  const Rect& w = plane.window;
  for (int y = w.y0; y < w.y1; ++y) {
    const auto row_holds = [&](float value) {
      return row_has(value, plane.row(y), plane.x_stride, w.width());
    };
    const bool has_asked = source.nothing && row_holds(asked);
    const bool has_zero = source.uncovered && row_holds(0);
    if (!has_asked && !has_zero) continue;
    for (int x = w.x0; x < w.x1; ++x) {
      float& z = plane.at(x, y);
      if ((has_asked && z == asked) || (has_zero && z == 0 && source.uncovered(x, y))) z = nothing;
    }
  }
}

}  // namespace limpid

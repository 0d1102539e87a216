#pragma once
#include <cmath>

#include "limpid/run/target.h"

#include "op/pixel.h"

namespace limpid {

/// The channels of a pixel's AOV; an AOV of one channel is in the first.
template <class F>
LIMPID_INLINE Vec3<F> aov_of(const Pixel<F>& p, Aov aov) {
  const auto rgb = [](const Rgb<F>& c) { return Vec3<F>{c.r, c.g, c.b}; };
  // The convention of compositing programs: (0, 0) at the lower left of the picture.
  const auto map = [&](const Vec2<F>& shift) {
    return Vec3<F>{p.uv.x + shift.x, F(1) - (p.uv.y + shift.y), F(0)};
  };
  switch (aov) {
    case Aov::kTransmitted:
      return rgb(p.transmitted);
    case Aov::kInScatter:
      return rgb(p.in_scatter);
    case Aov::kReflected:
      return rgb(p.reflected);
    case Aov::kHighlight:
      return rgb(p.highlight);
    case Aov::kFresnel:
      return {p.fresnel, F(0), F(0)};
    case Aov::kTransmittance:
      return rgb(p.transmittance);
    case Aov::kPath:
      return {p.path, F(0), F(0)};
    case Aov::kConfidence:
      return {p.confidence, F(0), F(0)};
    case Aov::kNormal:
      return p.normal;
    case Aov::kSurfaceDepth:
      return {select(abs(p.side) < F(0.5), F(HUGE_VAL), p.surface_depth), F(0), F(0)};
    case Aov::kStmapR:
      return map(p.shift_r);
    case Aov::kStmapG:
      return map(p.shift_g);
    case Aov::kStmapB:
      return map(p.shift_b);
    case Aov::kMirrorSources:
      return rgb(p.mirror_sources);
    case Aov::kReflectionDepth:
    case Aov::kReflectionValid:
    case Aov::kSky:
    case Aov::kSurfaceShadow:
      break;  // written by show_planes()
  }
  return {F(0), F(0), F(0)};
}

/// The same for a dry pixel, from its dry color and its own place; `dry` is AovInfo::dry.
template <class F>
LIMPID_INLINE Vec3<F> dry_aov_of(Aov aov, Rgb<F> color, Vec2<F> uv, F dry) {
  switch (aov) {
    case Aov::kTransmitted:
      return {color.r, color.g, color.b};
    case Aov::kStmapR:
    case Aov::kStmapG:
    case Aov::kStmapB:
      return {uv.x, F(1) - uv.y, F(0)};
    default:
      return {dry, dry, dry};
  }
}

}  // namespace limpid

#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "limpid/core/frame.h"
#include "limpid/core/plane.h"
#include "limpid/op/pixel.h"

namespace limpid {

/// What can be written besides the picture.
enum class Aov {
  kTransmitted,
  kInScatter,
  kReflected,
  kHighlight,
  kFresnel,
  kTransmittance,
  kPath,
  kConfidence,
  kNormal,
  kSurfaceDepth,
  kStmapR,
  kStmapG,
  kStmapB,
  kMirrorSources,
  kReflectionDepth,
  kReflectionValid,
  kSky,
};
constexpr int kAovCount = 17;

/// What a pixel of several samples shows.
enum class Filter : std::uint8_t {
  kMean,    ///< their mean: lights and shares
  kMiddle,  ///< the sample nearest to the middle: lengths, places and directions have no mean
};

struct AovInfo {
  std::string_view name;      ///< of the layer
  std::string_view suffixes;  ///< a letter a channel: "RGB", "XYZ", "UV", "Y", "Z"
  StateSet parts;             ///< state that it shows
  /// On dry pixels. There `transmitted` has the dry color instead, and the maps have the pixel's
  /// own place.
  float dry;
  Storage storage;  ///< in files, unless all is stored as float
  Filter filter;
  std::string_view about;
  /// Of the frame, as operators read them, of the plate or made (complete/completer.h), on all
  /// pixels; Role::missing where there are none.
  PlaneSet planes = {};
  /// Whether it tells of buffers or guesses, of which the ray-traced truth has none.
  bool of_buffers = false;
};
/// In the order of Aov. The first four sum to the picture on every pixel.
std::span<const AovInfo> aovs();
/// Throws Error with the nearest name.
Aov aov_named(std::string_view name);
/// What state a run must make for these to be shown.
StateSet state_shown_by(std::span<const Aov> list);

/// Where a run writes. The picture must be there; each AOV may be. All views must cover the frame's
/// work(); pixels of a view outside it are left alone. No view may share memory with the frame,
/// where lookups would find what was just written.
struct Target {
  std::array<View<float>, 3> color;
  View<float> alpha;  ///< may be absent
  /// Share of each pixel that nothing before the water covers: 1, but at edges (Frame::edges),
  /// where it is above 0; may be absent. The AOVs that sum to the picture are of that share, the
  /// others of the water alone.
  View<float> uncovered;
  std::array<std::array<View<float>, 3>, kAovCount> aovs;

  std::array<View<float>, 3>& of(Aov aov) { return aovs[static_cast<std::size_t>(aov)]; }
  const std::array<View<float>, 3>& of(Aov aov) const {
    return aovs[static_cast<std::size_t>(aov)];
  }
};

/// The channels of an AOV of a pixel; one-channel ones are in the first.
template <class F>
LIMPID_INLINE Vec3<F> aov_of(const Pixel<F>& p, Aov aov) {
  const auto rgb = [](const Rgb<F>& c) { return Vec3<F>{c.r, c.g, c.b}; };
  // As compositing programs have it: (0, 0) at the lower left of the picture.
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
      break;  // show_planes()
  }
  return {F(0), F(0), F(0)};
}

/// The same of a dry pixel, from its dry color and its own place; `dry` is AovInfo::dry.
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

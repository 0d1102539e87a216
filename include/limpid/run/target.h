#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "limpid/core/frame.h"
#include "limpid/core/plane.h"
#include "limpid/core/state.h"

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

}  // namespace limpid

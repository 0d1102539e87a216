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

/// The outputs besides the picture.
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

/// The value of a pixel with several samples.
enum class Filter : std::uint8_t {
  kMean,    ///< their mean: lights and shares
  kMiddle,  ///< the sample nearest to the middle: lengths, positions and directions have no mean
};

struct AovInfo {
  std::string_view name;      ///< of the layer
  std::string_view suffixes;  ///< a letter a channel: "RGB", "XYZ", "UV", "Y", "Z"
  StateSet parts;             ///< state that it shows
  /// The value on dry pixels. There `transmitted` has the dry color instead, and the maps have the
  /// pixel's own position.
  float dry;
  Storage storage;  ///< in files, unless all is stored as float
  Filter filter;
  std::string_view about;
  /// A plane of the frame, as operators read it, from the plate or from a completer
  /// (complete/completer.h), on all pixels; Role::missing if there is none.
  PlaneSet planes = {};
  /// Whether it shows buffers or guesses, which the path-traced truth lacks.
  bool of_buffers = false;
};
/// In the order of Aov. The first four sum to the picture on every pixel.
std::span<const AovInfo> aovs();
/// Throws Error with the nearest name.
Aov aov_named(std::string_view name);
/// The state that a run must make for these AOVs.
StateSet state_shown_by(std::span<const Aov> list);

/// The outputs of a run. The picture must be there; each AOV may be. All views must cover the
/// frame's work(); pixels of a view outside of it are left alone. No view may share memory with the
/// frame, where lookups would read results.
struct Target {
  std::array<View<float>, 3> color;
  View<float> alpha;  ///< may be absent
  /// Share of each pixel that no object in front of the water covers: 1 except at edges
  /// (Frame::edges), and above 0; may be absent. The AOVs that sum to the picture are of that
  /// share, the others of the water alone.
  View<float> uncovered;
  std::array<std::array<View<float>, 3>, kAovCount> aovs;

  std::array<View<float>, 3>& of(Aov aov) { return aovs[static_cast<std::size_t>(aov)]; }
  const std::array<View<float>, 3>& of(Aov aov) const {
    return aovs[static_cast<std::size_t>(aov)];
  }
};

}  // namespace limpid

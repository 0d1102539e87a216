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
  kSurfaceShadow,
};
constexpr int kAovCount = 18;

/// The way to combine several samples of a pixel.
enum class Filter : std::uint8_t {
  kMean,    ///< their mean, for light and shares
  kMiddle,  ///< the sample nearest to the middle, for lengths, positions and directions
};

struct AovInfo {
  std::string_view name;      ///< of the layer
  std::string_view suffixes;  ///< one letter per channel: "RGB", "XYZ", "UV", "Y", "Z"
  StateSet parts;             ///< the parts of the state that it outputs
  /// The value on dry pixels. Exceptions: `transmitted` has the dry color, and the maps have the
  /// pixel's own position.
  float dry;
  Storage storage;  ///< in files, unless the whole file is written as float
  Filter filter;
  std::string_view about;
  /// For an AOV that outputs a plane of the frame, from the plate or from a completer
  /// (complete/completer.h), on all pixels: this plane. Its value is Role::missing if the frame
  /// lacks it.
  PlaneSet planes = {};
  /// Whether the AOV depends on buffers or guesses, which the path-traced truth lacks.
  bool of_buffers = false;
};
/// All AOVs, in the order of Aov. The first four sum to the picture on every pixel.
std::span<const AovInfo> aovs();
/// Throws Error with the nearest name.
Aov aov_named(std::string_view name);
/// The state that a run must compute for these AOVs.
StateSet state_shown_by(std::span<const Aov> list);

/// The outputs of a run. The color must be present; each AOV may be. All views must cover the
/// frame's work(); pixels of a view outside of it stay unchanged. No view may share memory with the
/// frame, whose lookups would read results.
struct Target {
  std::array<View<float>, 3> color;
  View<float> alpha;  ///< may be absent
  /// Share of each pixel that no object in front of the water covers: 1 except at edges
  /// (Frame::edges), and above 0; may be absent. The AOVs that sum to the picture include that
  /// share; the others are those of the water alone.
  View<float> uncovered;
  std::array<std::array<View<float>, 3>, kAovCount> aovs;

  std::array<View<float>, 3>& of(Aov aov) { return aovs[static_cast<std::size_t>(aov)]; }
  const std::array<View<float>, 3>& of(Aov aov) const {
    return aovs[static_cast<std::size_t>(aov)];
  }
};

}  // namespace limpid

#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>

#include "limpid/core/color_space.h"
#include "limpid/core/plane.h"

/// @file
/// The conversion of scene-linear light to the colors of a screen.

namespace limpid {

/// Exposure and color transform of that conversion.
struct DisplayChoice {
  double exposure = 0;                ///< stops, -100 ... 100
  std::filesystem::path config = {};  ///< of OpenColorIO; empty for sRGB
  /// "DISPLAY/VIEW" of the config, or a view of its default display; "" for its default.
  std::string view = {};
};

/// The views of a config of OpenColorIO, as "DISPLAY/VIEW", the default first. Throws Error for an
/// invalid config, and without the format module, which has OpenColorIO.
std::vector<std::string> display_views(const std::filesystem::path& config);

/// The view that a name means, as in DisplayChoice::view. Throws Error with all views for an
/// unknown name.
std::string display_view(const std::filesystem::path& config, const std::string& name);

/// Converts scene-linear light to encoded values of a screen, 0 ... 1. Multiplies by 2^exposure;
/// then either converts to the primaries of Rec.709, clamps and encodes as sRGB, or applies a view
/// of a config, from the config's linear space with the light's primaries, else from another known
/// linear space of the config. NaN becomes black; for sRGB +inf becomes white. Several threads may
/// use one object.
class DisplayTransform {
 public:
  /// For light of these primaries. Throws Error for an exposure out of range, and for a missing
  /// config, display or view. A config is read once per process.
  explicit DisplayTransform(const DisplayChoice& choice = {}, const Primaries& primaries = kRec709);

  /// Converts red, green and blue, which must have one window.
  std::array<Plane, 3> displayed(const std::array<View<const float>, 3>& light) const;

 private:
  struct Ocio;
  double exposure_;
  std::optional<glm::mat3> matrix_;  ///< empty if the primaries stay
  std::shared_ptr<const Ocio> ocio_;
};

}  // namespace limpid

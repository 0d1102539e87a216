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
/// What a screen shows of light.

namespace limpid {

/// How it shows it.
struct DisplayChoice {
  double exposure = 0;                ///< stops, -100 ... 100
  std::filesystem::path config = {};  ///< of OpenColorIO; empty for sRGB
  /// Of the config: "DISPLAY/VIEW", or a view of its default display; "" for its default.
  std::string view = {};
};

/// What a config of OpenColorIO offers, as "DISPLAY/VIEW": its default first. Throws Error for what
/// is no config, and without the format module, through which OpenColorIO is reached.
std::vector<std::string> display_views(const std::filesystem::path& config);

/// The one of these that a name means, as DisplayChoice::view. Throws Error with all of them.
std::string display_view(const std::filesystem::path& config, const std::string& name);

/// From light to what is encoded for a screen, 0 ... 1. It multiplies by 2^exposure; then either
/// goes to the primaries of Rec.709, clamps and encodes as sRGB, or takes the view of a config,
/// from the space of it that has the light's primaries, else from another linear one that is known.
/// NaN is black; of sRGB +inf is as bright as can be. Any threads may use one.
class DisplayTransform {
 public:
  /// Of light of these primaries. Throws Error for an exposure out of range, and for a config, a
  /// display or a view that is not there. A config is read once a program.
  explicit DisplayTransform(const DisplayChoice& choice = {}, const Primaries& primaries = kRec709);

  /// Of red, green and blue of one window.
  std::array<Plane, 3> displayed(const std::array<View<const float>, 3>& light) const;

 private:
  struct Ocio;
  double exposure_;
  std::optional<glm::mat3> matrix_;  ///< none where the primaries stay
  std::shared_ptr<const Ocio> ocio_;
};

}  // namespace limpid

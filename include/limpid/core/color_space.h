#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>

/// @file
/// Color spaces of scene-linear pictures, by their primaries. All colors of a frame and its look
/// are in one such space, the working space.

namespace limpid {

/// A chromaticity in the CIE 1931 diagram.
struct Chromaticity {
  double x, y;
  friend bool operator==(const Chromaticity&, const Chromaticity&) = default;
};

/// The chromaticities of (1, 0, 0), (0, 1, 0), (0, 0, 1) and (1, 1, 1).
struct Primaries {
  Chromaticity red, green, blue, white;
  friend bool operator==(const Primaries&, const Primaries&) = default;

  /// Throws Error for numbers that are not finite or beyond -10 ... 10, for a white with y = 0, for
  /// primaries on one line, and for a white that no mixture of positive shares of the primaries
  /// has.
  void validate() const;
};

/// ITU-R BT.709, with the primaries of sRGB: the default, as in OpenEXR.
inline constexpr Primaries kRec709{{.64, .33}, {.30, .60}, {.15, .06}, {.3127, .3290}};

/// The main name of each known space, such as "ACEScg".
std::vector<std::string> color_space_names();

/// The space of a name: a name of color_space_names(), or the name in files and OpenColorIO's
/// configs ("lin_ap1", "ACES - ACEScg"). Letter case, spaces and punctuation are ignored. Names of
/// non-linear spaces are unknown.
std::optional<Primaries> find_color_space(std::string_view name);

/// The same, or from eight numbers: x and y of red, green, blue and white. Throws Error with the
/// known names for an unknown name, and as Primaries::validate().
Primaries color_space_named(std::string_view text);

/// The name of the space that agrees with these primaries to within 0.001; otherwise their eight
/// numbers, which color_space_named() reads back to the bit.
std::string to_string(const Primaries& primaries);

/// Whether all chromaticities agree to within 0.001, the precision of many files.
bool agree(const Primaries& a, const Primaries& b);

/// The matrix from RGB to CIE XYZ; white has Y = 1. SMPTE RP 177-1993, "Derivation of Basic
/// Television Color Equations".
glm::dmat3 xyz_from(const Primaries& primaries);

/// The matrix from RGB of one space to RGB of another. White stays white: if the two whites differ,
/// Bradford's matrix adapts them (Lam 1985, "Metamerism and Colour Constancy").
glm::dmat3 rgb_from_rgb(const Primaries& to, const Primaries& from);

}  // namespace limpid

#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>

/// @file
/// What red, green and blue of a scene-linear picture are. All numbers of a frame that are light or
/// a share of it are of one such space, its working space.

namespace limpid {

/// A place in the CIE 1931 diagram.
struct Chromaticity {
  double x, y;
  friend bool operator==(const Chromaticity&, const Chromaticity&) = default;
};

/// The colors that (1, 0, 0), (0, 1, 0), (0, 0, 1) and (1, 1, 1) have.
struct Primaries {
  Chromaticity red, green, blue, white;
  friend bool operator==(const Primaries&, const Primaries&) = default;

  /// Throws Error for numbers that are not finite, a white without light (y = 0), and primaries
  /// that lie on a line or whose mixture with positive shares the white is not.
  void validate() const;
};

/// ITU-R BT.709, of sRGB, too: what is meant where nobody says otherwise (OpenEXR has it so).
inline constexpr Primaries kRec709{{.64, .33}, {.30, .60}, {.15, .06}, {.3127, .3290}};

/// The first name of each space that is known, as "ACEScg".
std::vector<std::string> color_space_names();

/// The space of a name: one of those, or as files and OpenColorIO's configs call it ("lin_ap1",
/// "ACES - ACEScg"), whatever its letter case, spaces and signs. Names of spaces that are not
/// linear are not among them.
std::optional<Primaries> find_color_space(std::string_view name);

/// The same, or eight numbers: x and y of red, green, blue and white. Throws Error with the names,
/// and as Primaries::validate().
Primaries color_space_named(std::string_view text);

/// The name of the space that agrees with these to within 0.001; otherwise the eight numbers, which
/// color_space_named() reads back to the bit.
std::string to_string(const Primaries& primaries);

/// Whether they are one space, to within 0.001, which is what files store.
bool agree(const Primaries& a, const Primaries& b);

/// From red, green and blue to CIE XYZ, white having Y = 1. SMPTE RP 177-1993, "Derivation of Basic
/// Television Color Equations".
glm::dmat3 xyz_from(const Primaries& primaries);

/// From red, green and blue of one space to those of another. White stays white: where the two
/// whites differ, by Bradford's matrix (Lam 1985, "Metamerism and Colour Constancy").
glm::dmat3 rgb_from_rgb(const Primaries& to, const Primaries& from);

}  // namespace limpid

#pragma once
#include <string_view>

#include "show/shown.h"

namespace limpid {

/// Words in a picture, in letters of the project's own, 5 x 7 points and two below the line: labels
/// need no more, and a font of the system would be another library and a file that may not be
/// there. Letters are ASCII; for any other byte stands a box.
inline constexpr int kLetterWidth = 6, kLetterHeight = 10;  ///< with the gaps to the next ones

/// Writes a line of text, its upper left corner at (x, y), each point of a letter a square of
/// `scale` pixels. What would lie outside the picture is left out.
void put_text(Shown& picture, int x, int y, int scale, std::string_view text,
              std::array<std::uint8_t, 3> color);

}  // namespace limpid

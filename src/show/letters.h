#pragma once
#include <string_view>

#include "show/shown.h"

namespace limpid {

/// Text in a picture, in limpid's own letters, 5 x 7 dots and two below the line: enough for
/// labels; a font of the system would need another library and a file that may be missing. ASCII
/// only; any other byte becomes a box.
inline constexpr int kLetterWidth = 6, kLetterHeight = 10;  ///< with the gaps to the next letters

/// Draws a line of text, its upper left corner at (x, y), each dot of a letter a square of `scale`
/// pixels. Clipped to the picture.
void put_text(Shown& picture, int x, int y, int scale, std::string_view text,
              std::array<std::uint8_t, 3> color);

}  // namespace limpid

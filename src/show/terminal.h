#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "limpid/core/rect.h"

/// Pictures between the lines of a terminal.

namespace limpid {

/// How a terminal is told of a picture.
enum class TerminalPictures {
  kKitty,  ///< kitty's graphics protocol, a PNG: kitty, Ghostty
  kIterm,  ///< iTerm2's inline images, a PNG: iTerm2, WezTerm, mintty
  kSixel,  ///< DEC's sixels, 256 colors: foot, mlterm, Contour, Konsole, xterm -ti 340
};

/// "kitty", "iterm", "sixel". Throws the usage Error with the nearest name.
TerminalPictures terminal_pictures_named(std::string_view name);

/// Of the terminal that the environment tells of; nothing is asked of the terminal itself. Nothing
/// where it is not known to show pictures, and within tmux and screen, which keep them to
/// themselves. `variable` gives a variable of the environment, null where it is not set.
std::optional<TerminalPictures> terminal_pictures(
    const std::function<const char*(const char*)>& variable);

/// What is to be written to the terminal, with the line's end: rgb are the picture's bytes, rows
/// from the top.
std::string terminal_text(Size size, std::span<const std::uint8_t> rgb, TerminalPictures way);

}  // namespace limpid

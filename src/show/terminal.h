#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "limpid/core/rect.h"

/// Pictures in a terminal, between its lines.

namespace limpid {

/// Protocols for pictures in terminals.
enum class TerminalPictures {
  kKitty,  ///< kitty's graphics protocol, a PNG: kitty, Ghostty
  kIterm,  ///< iTerm2's inline images, a PNG: iTerm2, WezTerm, mintty
  kSixel,  ///< DEC's sixels, 256 colors: foot, mlterm, Contour, Konsole, xterm -ti 340
};

/// Parses "kitty", "iterm", "sixel". Throws the usage Error with the nearest name.
TerminalPictures terminal_pictures_named(std::string_view name);

/// The protocol of the terminal named by the environment; the terminal itself is not queried.
/// Nothing if it is not known to show pictures, and within tmux and screen, which do not pass them
/// on. `variable` returns a variable of the environment, null if it is not set.
std::optional<TerminalPictures> terminal_pictures(
    const std::function<const char*(const char*)>& variable);

/// The text for the terminal, with a line end: rgb are the picture's bytes, rows from the top.
std::string terminal_text(Size size, std::span<const std::uint8_t> rgb, TerminalPictures protocol);

}  // namespace limpid

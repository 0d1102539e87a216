#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "limpid/core/rect.h"

/// The pictures that a terminal would draw from a program's output.

namespace limpid::test {

struct Decoded {
  Size size;
  std::vector<std::uint8_t> rgb;
};

/// The only picture in the text; other words may stand before the picture. Fails the test, and
/// returns an empty picture, for a text that breaks the protocol.
Decoded decoded_kitty(const std::string& text);
Decoded decoded_iterm(const std::string& text);
Decoded decoded_sixel(const std::string& text);

/// The bytes of a picture file as a screen gets them.
Decoded decoded_file(const std::filesystem::path& path);

/// The difference of two pictures of one size, of 255.
struct Apart {
  double mean = 0;
  int most = 0;
};
Apart apart(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b);

}  // namespace limpid::test

#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "limpid/core/rect.h"

/// What a terminal would draw of what was written to it.

namespace limpid::test {

struct Decoded {
  Size size;
  std::vector<std::uint8_t> rgb;
};

/// The one picture in the text, which may have other words before it. Fails the test, and is empty,
/// for a text that is not as the protocol has it.
Decoded decoded_kitty(const std::string& text);
Decoded decoded_iterm(const std::string& text);
Decoded decoded_sixel(const std::string& text);

/// A picture file, as the bytes that a screen gets of it.
Decoded decoded_file(const std::filesystem::path& path);

/// How far two pictures of one size are apart, of 255.
struct Apart {
  double mean = 0;
  int most = 0;
};
Apart apart(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b);

}  // namespace limpid::test

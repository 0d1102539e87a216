#pragma once
#include <array>
#include <charconv>
#include <string>

namespace limpid {

/// Six digits, in any locale.
inline std::string number_text(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, 6);
  return {text.data(), end.ptr};
}

}  // namespace limpid

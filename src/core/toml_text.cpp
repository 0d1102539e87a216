#include "core/toml_text.h"

#include <charconv>
#include <cstdio>

namespace limpid {

std::string toml_text(const std::string& word) {
  std::string quoted = "\"";
  for (char c : word) {
    if (const int code = static_cast<unsigned char>(c); code < 0x20 || code == 0x7f) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04X", code);
      quoted += escaped;
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string toml_text(double x) {
  char digits[32];
  const std::string text(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

}  // namespace limpid

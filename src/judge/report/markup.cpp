#include "judge/report/markup.h"

#include <array>
#include <charconv>
#include <cmath>

namespace limpid {
namespace {

std::string fixed(double value, int digits) {
  std::array<char, 400> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, digits);
  return {text.data(), end.ptr};
}

std::string power_of_ten(int power) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = power < 0 ? "10⁻" : "10";
  for (char digit : std::to_string(std::abs(power))) text += kDigits[digit - '0'];
  return text;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += byte < 0x20 || byte == 0x7f ? '?' : c;
    }
  }
  return result;
}

std::string coordinate(double value) {
  std::string text = fixed(value, 2);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string short_number(double value) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0 ? "∞" : "-∞";
  if (value == 0) return "0";
  // Of the number as it will be rounded: 999.6 has four digits before the point.
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::scientific, 2);
  const std::string_view scientific(text.data(), end.ptr);
  const std::size_t e = scientific.find('e');
  const int power = std::stoi(std::string(scientific.substr(e + 1)));
  if (power >= -3 && power <= 4) return fixed(value, power > 2 ? 0 : 2 - power);
  return std::string(scientific.substr(0, e)) + "·" + power_of_ten(power);
}

std::string plain_number(double value) {
  std::array<char, 400> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return {text.data(), end.ptr};
}

std::string tick_number(int digit, int power) {
  if (power >= 0 && power <= 4) return std::to_string(digit) + std::string(power, '0');
  if (power < 0 && power >= -3) return "0." + std::string(-power - 1, '0') + std::to_string(digit);
  return (digit == 1 ? "" : std::to_string(digit) + "·") + power_of_ten(power);
}

}  // namespace limpid

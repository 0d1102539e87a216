#include "judge/report/numbers.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace limpid {
namespace {

std::string power_of_ten(int power) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = power < 0 ? "10⁻" : "10";
  for (char digit : std::to_string(std::abs(power))) text += kDigits[digit - '0'];
  return text;
}

}  // namespace

std::string short_number(double value) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0 ? "∞" : "-∞";
  if (value == 0) return "0";
  std::array<char, 32> text;
  const auto written = [&](std::chars_format format, int digits) {
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, digits);
    return std::string(text.data(), end.ptr);
  };
  // For the number after rounding: 999.6 has four digits before the point.
  const std::string scientific = written(std::chars_format::scientific, 2);
  const std::size_t e = scientific.find('e');
  const int power = std::stoi(scientific.substr(e + 1));
  if (power >= -3 && power <= 4)
    return written(std::chars_format::fixed, power > 2 ? 0 : 2 - power);
  return scientific.substr(0, e) + "·" + power_of_ten(power);
}

std::string plain_number(double value) {
  std::array<char, 400> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return {text.data(), end.ptr};
}

}  // namespace limpid

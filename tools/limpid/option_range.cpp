#include "option_range.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace limpid::tool {
namespace {

/// A validator without a name, which adds nothing to the help.
CLI::Validator validator(std::function<std::string(const std::string&)> fault_of) {
  return CLI::Validator([=](std::string& word) { return fault_of(word); }, "");
}

std::string text_of(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

std::string range_text(double least, double most) {
  if (std::isinf(least) && std::isinf(most)) return "a finite number";
  if (std::isinf(most)) return "a finite number from " + text_of(least) + " up";
  return text_of(least) + " ... " + text_of(most);
}

/// "" if the word is no number: the conversion reports that.
template <class Holds>
std::string fault_of_number(const std::string& word, const Holds& holds,
                            const std::string& expected) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  const bool is_number = !word.empty() && *end == '\0';
  return !is_number || holds(number) ? "" : word + ": expected " + expected;
}

/// Whether the word is a whole number of the type in the range.
template <class Whole>
bool is_whole(const std::string& word, Whole least, Whole most) {
  Whole number = 0;
  const char* end = word.data() + word.size();
  const auto read = std::from_chars(word.data(), end, number);
  return read.ec == std::errc() && read.ptr == end && number >= least && number <= most;
}

}  // namespace

CLI::Validator number_in(double least, double most, const std::string& unit) {
  const std::string expected = range_text(least, most) + (unit.empty() ? "" : " (" + unit + ")");
  return validator([=](const std::string& word) {
    const auto holds = [=](double x) { return x >= least && x <= most && !std::isinf(x); };
    return fault_of_number(word, holds, expected);
  });
}

CLI::Validator number_above_zero() {
  return validator([](const std::string& word) {
    const auto holds = [](double x) { return x > 0 && !std::isinf(x); };
    return fault_of_number(word, holds, "a finite number above 0");
  });
}

CLI::Validator whole_number_in(std::int64_t least, std::uint64_t most) {
  const std::string expected =
      ": expected a whole number, " + std::to_string(least) + " ... " + std::to_string(most);
  return validator([=](const std::string& word) {
    const bool good = least < 0
                          ? is_whole<std::int64_t>(word, least, static_cast<std::int64_t>(most))
                          : is_whole<std::uint64_t>(word, static_cast<std::uint64_t>(least), most);
    return good ? "" : word + expected;
  });
}

}  // namespace limpid::tool

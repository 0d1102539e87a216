#include "files/text/json_place.h"

#include <algorithm>
#include <cmath>

#include "limpid/core/error.h"

namespace limpid {
namespace {

using nlohmann::json;

// Later readers of the values are recursive.
constexpr int kDeepest = 64;
constexpr std::size_t kLongest = 40;  // characters of a value in a sentence

// Upper bound on the memory of a text, including copies, as measured.
constexpr std::int64_t kBytesAByte = 7, kBytesAValue = 512;

std::string shown(const json& value) {
  if (value.is_object()) return "{...}";
  if (value.is_array()) return "[...] of " + std::to_string(value.size());
  std::string text = value.dump(-1, ' ', true);
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

}  // namespace

void JsonPlace::refuse(const std::string& expected) const {
  throw Error((path_.empty() ? "the file" : path_) + " = " + shown(*value_) + ": expected " +
              expected);
}

void JsonPlace::expect_object() const {
  if (!value_->is_object()) refuse("an object");
}

std::optional<JsonPlace> JsonPlace::find(std::string_view key) const {
  expect_object();
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonPlace(*found, path_.empty() ? std::string(key) : path_ + "." + std::string(key));
}

JsonPlace JsonPlace::at(std::string_view key) const {
  if (const std::optional<JsonPlace> found = find(key)) return *found;
  throw Error((path_.empty() ? "the file" : path_) + ": expected \"" + std::string(key) +
              "\" in it");
}

std::vector<JsonPlace> JsonPlace::list(std::string_view key) const {
  const std::optional<JsonPlace> found = find(key);
  return found ? found->items() : std::vector<JsonPlace>{};
}

std::vector<JsonPlace> JsonPlace::items() const {
  if (!value_->is_array()) refuse("a list");
  std::vector<JsonPlace> items;
  items.reserve(value_->size());
  for (const json& item : *value_) {
    items.emplace_back(item, path_ + "[" + std::to_string(items.size()) + "]");
  }
  return items;
}

std::size_t JsonPlace::count(std::string_view key) const {
  const std::optional<JsonPlace> found = find(key);
  if (found && !found->value_->is_array()) found->refuse("a list");
  return found ? found->value_->size() : 0;
}

std::vector<std::string> JsonPlace::keys() const {
  expect_object();
  std::vector<std::string> keys;
  for (const auto& [key, value] : value_->items()) keys.push_back(key);
  return keys;
}

std::optional<JsonPlace> JsonPlace::extras() const {
  const std::optional<JsonPlace> extras = find("extras");
  if (!extras || !extras->value_->is_object())
    return std::nullopt;  // another program's, of any type
  return extras->find("limpid");
}

void JsonPlace::expect_keys(const std::vector<std::string>& known) const {
  expect_object();
  for (const auto& [key, value] : value_->items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    throw Error(path_ + ": unknown key '" + key + "', expected one of " + join(known) +
                did_you_mean(key, known));
  }
}

std::int64_t JsonPlace::integer(std::int64_t lowest, std::int64_t highest) const {
  const std::string expected = "an integer from " + std::to_string(lowest) +
                               (highest == INT64_MAX ? " up" : " to " + std::to_string(highest));
  if (!value_->is_number_integer()) refuse(expected);
  if (value_->is_number_unsigned() && value_->get<std::uint64_t>() > INT64_MAX) refuse(expected);
  const auto integer = value_->get<std::int64_t>();
  if (integer < lowest || integer > highest) refuse(expected);
  return integer;
}

int JsonPlace::index(std::size_t count) const {
  const bool good = value_->is_number_unsigned() &&
                    value_->get<std::uint64_t>() < std::min<std::size_t>(count, INT32_MAX);
  if (!good) refuse("an index below " + std::to_string(count));
  return value_->get<int>();
}

double JsonPlace::number() const {
  if (!value_->is_number() || !std::isfinite(value_->get<double>())) refuse("a number");
  return value_->get<double>();
}

bool JsonPlace::boolean() const {
  if (!value_->is_boolean()) refuse("true or false");
  return value_->get<bool>();
}

const std::string& JsonPlace::text() const {
  if (!value_->is_string()) refuse("a string");
  return value_->get_ref<const std::string&>();
}

std::vector<double> JsonPlace::numbers(std::size_t count) const {
  if (!value_->is_array() || value_->size() != count) {
    refuse("a list of " + std::to_string(count) + " numbers");
  }
  std::vector<double> numbers;
  for (const JsonPlace& item : items()) numbers.push_back(item.number());
  return numbers;
}

std::vector<double> JsonPlace::color() const {
  std::vector<double> color = numbers(3);
  if (std::any_of(color.begin(), color.end(), [](double c) { return c < 0; })) {
    refuse("three numbers from 0 up");
  }
  return color;
}

std::size_t JsonPlace::choice(std::span<const std::string_view> words) const {
  const auto found = std::find(words.begin(), words.end(), text());
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  const std::vector<std::string> known(words.begin(), words.end());
  refuse("one of " + join(known) + did_you_mean(text(), known));
}

std::int64_t json_memory(std::string_view text) {
  std::int64_t values = 1;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (letter == '"') in_string = !in_string;
    if (in_string && letter == '\\') ++i;
    if (in_string) continue;
    const bool opens = letter == '[' || letter == '{';
    if (opens && ++depth > kDeepest) {
      throw Error("its JSON is nested more than " + std::to_string(kDeepest) + " deep");
    }
    if (letter == ']' || letter == '}') --depth;
    if (opens || letter == ',') ++values;
  }
  return kBytesAByte * std::ssize(text) + kBytesAValue * values;
}

json parse_json(std::string_view text) {
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::exception& exception) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    const std::string_view message = exception.what();
    throw Error("not JSON: " +
                std::string(message.substr(std::min(message.find("] ") + 2, message.size()))));
  }
}

}  // namespace limpid

#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace limpid {

/// A value of a JSON document with its place, for error sentences: "meshes[2].primitives[0].indices
/// = 9: expected an index below 4". All accessors throw Error for an unexpected value.
class JsonPlace {
 public:
  explicit JsonPlace(const nlohmann::json& value, std::string path = "")
      : value_(&value), path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  [[noreturn]] void refuse(const std::string& expected) const;

  /// The member of an object, if present.
  std::optional<JsonPlace> find(std::string_view key) const;
  /// The member of an object; throws Error if it is missing.
  JsonPlace at(std::string_view key) const;
  /// The elements of the list `key` of this object; empty if it is missing.
  std::vector<JsonPlace> list(std::string_view key) const;
  std::vector<JsonPlace> items() const;
  /// The size of list(key).
  std::size_t count(std::string_view key) const;
  void expect_object() const;
  /// The keys of an object.
  std::vector<std::string> keys() const;
  /// The member "limpid" of the member "extras", if present.
  std::optional<JsonPlace> extras() const;
  /// Throws unless every key of the object is known; suggests the nearest known name.
  void expect_keys(const std::vector<std::string>& known) const;

  std::int64_t integer(std::int64_t lowest, std::int64_t highest) const;
  /// An index into a list of `count` elements.
  int index(std::size_t count) const;
  double number() const;
  bool boolean() const;
  const std::string& text() const;
  std::vector<double> numbers(std::size_t count) const;
  /// Three numbers from 0 up.
  std::vector<double> color() const;
  /// The index of this word in `words`.
  std::size_t choice(std::span<const std::string_view> words) const;

  friend bool operator==(const JsonPlace& a, const JsonPlace& b) { return a.value_ == b.value_; }

 private:
  const nlohmann::json* value_;
  std::string path_;
};

/// Upper bound on the memory of parsing a text, for any content. Throws Error for a nesting deeper
/// than any glTF needs. To be called before parse_json(), whose parser is recursive; checking the
/// depth during parsing would take quadratic time.
std::int64_t json_memory(std::string_view text);

/// Throws Error for text that is not JSON.
nlohmann::json parse_json(std::string_view text);

}  // namespace limpid

#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/error.h"

namespace limpid {

/// A value of a TOML file with its place, for error sentences. Entries of a table and elements of a
/// list are both `items`, in the order of the file.
struct TomlNode {
  enum class Kind { kNumber, kText, kList, kTable, kOther };

  Kind kind = Kind::kTable;
  std::string key;        ///< within its table; "" for the file itself and in lists
  std::string path;       ///< "camera.view[2]", for sentences
  std::string place;      ///< "lagoon.toml:9:12: ", of the value
  std::string key_place;  ///< the same of its key
  double number = 0;      ///< kNumber: integers and floats alike, NaN and infinities included
  std::string text;       ///< kText; kOther: "true", "false", "a date or time"
  std::vector<TomlNode> items;

  /// The entry of a table, or nullptr.
  const TomlNode* find(std::string_view name) const;

  /// Throws Error "file:line:column: path = value: expected ...".
  [[noreturn]] void refuse(const std::string& expected) const;

  /// Throws Error unless this is a table and its keys are all known; suggests the nearest known
  /// name.
  void expect_keys(std::span<const std::string> known) const;

  /// The value itself; throws Error if it is of another kind, or NaN or infinite.
  double finite_number() const;
  const std::string& word() const;
  /// Exactly `count` finite numbers.
  std::vector<double> finite_numbers(std::size_t count) const;
};

/// Calls `work`; prepends `place` to an Error. Hidden, so that its instantiations in headers export
/// no symbol to hosts.
template <class Work>
[[gnu::visibility("hidden")]] auto at_place(const std::string& place, Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(place + error.what(), error.fault());
  }
}

/// Throws Error for a file that cannot be read, is larger than 256 KiB, nested more than 16 deep,
/// or is not TOML; it begins with the path, and with line and column if known.
TomlNode parse_toml(const std::filesystem::path& path);

/// The same for a text that is not a file of its own; `name` replaces the path.
TomlNode parse_toml_text(const std::string& text, const std::string& name);

}  // namespace limpid

#include "files/text/toml.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>

#include <toml++/toml.h>

namespace limpid {
namespace {

// A node of two bytes of text takes about 400 bytes of memory.
constexpr std::streamsize kMaxBytes = std::streamsize{256} << 10;
constexpr std::size_t kLongestKey = 64, kLongestText = 80;  // in error sentences
// Every node has its path.
constexpr std::size_t kLongestPath = 512;

std::string text_of_file(const std::filesystem::path& path) {
  std::error_code absent;
  if (std::filesystem::is_directory(path, absent)) {
    throw Error(path.string() + ": is a folder, expected a TOML file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path.string() + ": cannot be opened (" + std::strerror(errno) + ")");
  std::string text(static_cast<std::size_t>(kMaxBytes) + 1, '\0');
  file.read(text.data(), kMaxBytes + 1);
  if (file.bad()) throw Error(path.string() + ": cannot be read", Fault::kRetry);
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

constexpr int kDeepest = 16;  // brackets, and dots of a key

/// Scans a text token by token and refuses nesting of brackets or dots deeper than limpid's files
/// need: toml++ limits brackets at 256 and dots not at all, and is recursive. Invalid TOML is left
/// for the parser to refuse.
class Nesting {
 public:
  Nesting(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  void check() {
    while (at_ < text_.size()) {
      const char letter = text_[at_];
      if (letter == '"' || letter == '\'') {
        skip_string(letter);
        continue;
      }
      if (letter == '#') at_ = std::min(text_.find('\n', at_), text_.size());
      if (at_ < text_.size()) take(text_[at_++]);
    }
  }

 private:
  void take(char letter) {
    switch (letter) {
      case '.':  // of a key, or of a number, which has at most one
        if (++dots_ > kDeepest) refuse("a key of more than " + std::to_string(kDeepest) + " dots");
        break;
      case '[':
      case '{':
        dots_ = 0;
        if (++depth_ > kDeepest) {
          refuse("brackets nested more than " + std::to_string(kDeepest) + " deep");
        }
        break;
      case ']':
      case '}':
        dots_ = 0;
        depth_ = std::max(depth_ - 1, 0);
        break;
      case '\n':
      case ',':
      case '=':
        dots_ = 0;
        break;
    }
  }

  /// A string ends at its quote or, if invalid, with the line; one of three quotes at three.
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool long_one = text_.substr(at_).starts_with(three);
    const std::string_view end = std::string_view(three).substr(0, long_one ? 3 : 1);
    at_ += end.size();
    while (at_ < text_.size() && !text_.substr(at_).starts_with(end)) {
      if (text_[at_] == '\n' && !long_one) return;
      at_ += text_[at_] == '\\' && quote == '"' ? 2 : 1;
    }
    at_ = std::min(at_ + end.size(), text_.size());
    // The last three of up to five quotes are the end.
    for (int more = 0; long_one && more < 2 && at_ < text_.size() && text_[at_] == quote; ++more) {
      ++at_;
    }
  }

  [[noreturn]] void refuse(const std::string& what) const {
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + static_cast<long>(at_ - 1), '\n');
    throw Error(name_ + ":" + std::to_string(line) + ": " + what);
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int dots_ = 0, depth_ = 0;
};

std::string place_of(const std::string& file, const toml::source_region& region) {
  return file + ":" + std::to_string(region.begin.line) + ":" +
         std::to_string(region.begin.column) + ": ";
}

TomlNode converted(const toml::node& value, const std::string& file, const std::string& path) {
  if (path.size() > kLongestPath) {
    throw Error(place_of(file, value.source()) + "keys in keys of " + std::to_string(path.size()) +
                " letters in all: expected at most " + std::to_string(kLongestPath));
  }
  TomlNode node;
  node.path = path;
  node.place = node.key_place = place_of(file, value.source());
  switch (value.type()) {
    case toml::node_type::integer:
      node.kind = TomlNode::Kind::kNumber;
      node.number = static_cast<double>(value.as_integer()->get());
      break;
    case toml::node_type::floating_point:
      node.kind = TomlNode::Kind::kNumber;
      node.number = value.as_floating_point()->get();
      break;
    case toml::node_type::string:
      node.kind = TomlNode::Kind::kText;
      node.text = value.as_string()->get();
      break;
    case toml::node_type::array:
      node.kind = TomlNode::Kind::kList;
      for (const toml::node& item : *value.as_array()) {
        const std::string index = "[" + std::to_string(node.items.size()) + "]";
        node.items.push_back(converted(item, file, path + index));
      }
      break;
    case toml::node_type::table: {
      node.kind = TomlNode::Kind::kTable;
      std::vector<std::pair<toml::source_position, TomlNode>> entries;
      for (const auto& [key, item] : *value.as_table()) {
        const std::string name(key.str());
        if (name.size() > kLongestKey) {
          throw Error(place_of(file, key.source()) + "a key of " + std::to_string(name.size()) +
                      " letters: expected at most " + std::to_string(kLongestKey));
        }
        TomlNode entry = converted(item, file, path.empty() ? name : path + "." + name);
        entry.key = name;
        entry.key_place = place_of(file, key.source());
        entries.emplace_back(key.source().begin, std::move(entry));
      }
      std::sort(entries.begin(), entries.end(),
                [](const auto& a, const auto& b) { return a.first < b.first; });
      for (auto& [position, entry] : entries) node.items.push_back(std::move(entry));
      break;
    }
    case toml::node_type::boolean:
      node.kind = TomlNode::Kind::kOther;
      node.text = value.as_boolean()->get() ? "true" : "false";
      break;
    default:
      node.kind = TomlNode::Kind::kOther;
      node.text = "a date or time";
      break;
  }
  return node;
}

std::string shortened(const std::string& text) {
  return text.size() > kLongestText ? text.substr(0, kLongestText) + "..." : text;
}

std::string shown(const TomlNode& node) {
  switch (node.kind) {
    case TomlNode::Kind::kNumber: {
      char text[32];
      std::snprintf(text, sizeof text, "%.9g", node.number);
      return text;
    }
    case TomlNode::Kind::kText:
      return "\"" + shortened(node.text) + "\"";
    case TomlNode::Kind::kList: {
      const bool short_and_flat =
          node.items.size() <= 4 &&
          std::all_of(node.items.begin(), node.items.end(), [](const TomlNode& item) {
            return item.kind != TomlNode::Kind::kList && item.kind != TomlNode::Kind::kTable;
          });
      if (!short_and_flat) return "a list of " + std::to_string(node.items.size());
      std::vector<std::string> items;
      for (const TomlNode& item : node.items) items.push_back(shown(item));
      return "[" + join(items) + "]";
    }
    case TomlNode::Kind::kTable:
      return "a table";
    case TomlNode::Kind::kOther:
      return node.text;
  }
  return {};
}

}  // namespace

const TomlNode* TomlNode::find(std::string_view name) const {
  for (const TomlNode& item : items) {
    if (item.key == name) return &item;
  }
  return nullptr;
}

void TomlNode::refuse(const std::string& expected) const {
  throw Error(place + path + " = " + shown(*this) + ": expected " + expected);
}

void TomlNode::expect_keys(std::span<const std::string> known) const {
  if (kind != Kind::kTable) refuse("a table");
  const std::vector<std::string> names(known.begin(), known.end());
  for (const TomlNode& item : items) {
    if (std::find(names.begin(), names.end(), item.key) != names.end()) continue;
    throw Error(item.key_place + "unknown " + (path.empty() ? "table" : "key") + " '" + item.path +
                "': expected one of " + join(names) + did_you_mean(item.key, names));
  }
}

double TomlNode::finite_number() const {
  if (kind != Kind::kNumber || !std::isfinite(number)) refuse("a finite number");
  return number;
}

const std::string& TomlNode::word() const {
  if (kind != Kind::kText) refuse("a string");
  return text;
}

std::vector<double> TomlNode::finite_numbers(std::size_t count) const {
  if (kind != Kind::kList || items.size() != count) {
    refuse("a list of " + std::to_string(count) + " numbers");
  }
  std::vector<double> numbers;
  for (const TomlNode& item : items) numbers.push_back(item.finite_number());
  return numbers;
}

TomlNode parse_toml(const std::filesystem::path& path) {
  return parse_toml_text(text_of_file(path), path.string());
}

TomlNode parse_toml_text(const std::string& text, const std::string& name) {
  if (std::ssize(text) > kMaxBytes) {
    throw Error(name + ": is larger than 256 KiB, expected a TOML file");
  }
  Nesting(text, name).check();
  try {
    return converted(toml::parse(text, name), name, "");
  } catch (const toml::parse_error& error) {
    throw Error(place_of(name, error.source()) + std::string(error.description()));
  }
}

}  // namespace limpid

#include "limpid/files/text/look_file.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <system_error>

#include "files/text/toml.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

std::string words_of(const Parameter& parameter) {
  return join({parameter.choices.begin(), parameter.choices.end()});
}

std::string expected_of(const Parameter& parameter) {
  switch (parameter.kind) {
    case FieldKind::kReal:
      return "a number";
    case FieldKind::kColor:
      return "three numbers [r, g, b]";
    case FieldKind::kChoice:
      return "one of " + words_of(parameter);
    case FieldKind::kText:
      return "a text";
    case FieldKind::kCountOrWord:
      return "a whole number or one of " + words_of(parameter);
    case FieldKind::kTable:
      return "a list of " + columns_text(parameter);
  }
  return {};
}

bool is_number(const TomlNode& node) { return node.kind == TomlNode::Kind::kNumber; }

bool is_list_of_numbers(const TomlNode& node) {
  return node.kind == TomlNode::Kind::kList &&
         std::all_of(node.items.begin(), node.items.end(), is_number);
}

std::optional<Rows> rows_of(const TomlNode& node) {
  if (node.kind != TomlNode::Kind::kList) return std::nullopt;
  Rows rows;
  for (const TomlNode& item : node.items) {
    if (!is_list_of_numbers(item)) return std::nullopt;
    std::vector<double>& row = rows.emplace_back();
    for (const TomlNode& number : item.items) row.push_back(number.number);
  }
  return rows;
}

/// The node as what the parameter holds; its range is left to Look::set.
Value value_of(const TomlNode& node, const Parameter& parameter) {
  switch (parameter.kind) {
    case FieldKind::kReal:
      if (is_number(node)) return node.number;
      break;
    case FieldKind::kColor:
      if (is_list_of_numbers(node) && node.items.size() == 3) {
        return Rgb<double>{node.items[0].number, node.items[1].number, node.items[2].number};
      }
      break;
    case FieldKind::kChoice:
    case FieldKind::kText:
      if (node.kind == TomlNode::Kind::kText) return node.text;
      break;
    case FieldKind::kCountOrWord:
      if (is_number(node)) return node.number;
      if (node.kind == TomlNode::Kind::kText) return node.text;
      break;
    case FieldKind::kTable:
      if (const std::optional<Rows> rows = rows_of(node)) return *rows;
      break;
  }
  node.refuse(expected_of(parameter));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// `text` without the pair `open` `close` around it, if it has one.
std::string_view without(char open, char close, std::string_view text) {
  const bool inside = text.size() >= 2 && text.front() == open && text.back() == close;
  return inside ? trimmed(text.substr(1, text.size() - 2)) : text;
}

std::optional<double> number_in(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<Rgb<double>> color_in(std::string_view text) {
  double channels[3];
  text = without('[', ']', text);
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',');
    if ((i < 2) != (comma != std::string_view::npos)) return std::nullopt;
    const std::optional<double> number = number_in(text.substr(0, comma));
    if (!number) return std::nullopt;
    channels[i] = *number;
    if (i < 2) text.remove_prefix(comma + 1);
  }
  return Rgb<double>{channels[0], channels[1], channels[2]};
}

/// Rows as TOML writes them: [[1, 2], [3, 4]].
std::optional<Rows> rows_in(std::string_view text) {
  try {
    const TomlNode root = parse_toml_text("rows = " + std::string(text), "");
    return root.items.size() == 1 ? rows_of(root.items[0]) : std::nullopt;
  } catch (const Error&) {
    return std::nullopt;  // the caller says it better
  }
}

/// The text of a setting as what the parameter holds, or nothing where it cannot be that.
std::optional<Value> value_in(std::string_view text, FieldKind kind) {
  switch (kind) {
    case FieldKind::kReal:
      return number_in(text);
    case FieldKind::kColor:
      return color_in(text);
    case FieldKind::kCountOrWord:
      if (const std::optional<double> count = number_in(text)) return *count;
      [[fallthrough]];
    case FieldKind::kChoice:
    case FieldKind::kText:
      return std::string(without('"', '"', text));
    case FieldKind::kTable:
      return rows_in(text);
  }
  return std::nullopt;
}

/// Relative file names in the look become absolute.
void resolve_files(Look& look, const fs::path& folder) {
  std::string& map = look.of<WaveNormals>().map;
  if (!map.empty()) map = (folder / map).lexically_normal().string();
}

std::vector<std::string> looks_in(std::span<const fs::path> folders) {
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code absent;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, absent)) {
      if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

Look look_of(const TomlNode& root, std::string name) {
  Look look;
  look.name = std::move(name);
  const std::vector<Parameter> all = parameters(look);
  std::vector<std::string> tables;
  for (const Parameter& p : all) {
    if (tables.empty() || tables.back() != p.table) tables.emplace_back(p.table);
  }
  root.expect_keys(tables);
  for (const TomlNode& table : root.items) {
    std::vector<std::string> keys;
    for (const Parameter& p : all) {
      if (p.table == table.key) keys.emplace_back(p.name);
    }
    table.expect_keys(keys);
    for (const Parameter& p : all) {
      const TomlNode* node = p.table == table.key ? table.find(p.name) : nullptr;
      if (!node) continue;
      const Value value = value_of(*node, p);
      at_place(node->place, [&] { look.set(p.table, p.name, value); });
    }
  }
  return look;
}

}  // namespace

Look load_look(const fs::path& path) {
  Look look = look_of(parse_toml(path), path.stem().string());
  resolve_files(look, fs::absolute(path).parent_path());
  look.file = fs::absolute(path).string();
  return look;
}

Look look_from_toml(const std::string& text, const std::string& name) {
  return look_of(parse_toml_text(text, name), name);
}

Look look_named(std::string_view name, std::span<const fs::path> folders) {
  const fs::path path(name);
  if (path.extension() == ".toml" || path.has_parent_path()) return load_look(path);
  for (const fs::path& folder : folders) {
    const fs::path file = folder / (path.string() + ".toml");
    std::error_code absent;
    if (fs::exists(file, absent)) return load_look(file);
  }
  const std::vector<std::string> known = looks_in(folders);
  throw Error("no look is named '" + path.string() + "': expected " +
              (known.empty() ? "the path of a look file" : "one of " + join(known)) +
              did_you_mean(name, known));
}

void apply_setting(Look& look, std::string_view setting) {
  const std::size_t equals = setting.find('=');
  const std::string_view name = trimmed(setting.substr(0, equals));
  const std::size_t dot = name.find('.');
  if (equals == std::string_view::npos || dot == std::string_view::npos) {
    throw Error("setting '" + std::string(setting) + "': expected operator.parameter=value",
                Fault::kUsage);
  }
  const std::string_view table = name.substr(0, dot), key = name.substr(dot + 1);
  const std::string_view text = trimmed(setting.substr(equals + 1));
  std::optional<Value> value = Value(std::string(text));
  for (const Parameter& p : parameters(look)) {
    if (p.table != table || p.name != key) continue;
    value = value_in(text, p.kind);
    if (!value) {
      throw Error(std::string(name) + " = " + std::string(text) + ": expected " + expected_of(p),
                  Fault::kUsage);
    }
  }
  try {
    look.set(table, key, *value);
  } catch (const Error& error) {
    throw Error(error.what(), Fault::kUsage);
  }
  resolve_files(look, fs::current_path());
}

}  // namespace limpid

#include "files/text/toml_value.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "core/toml_text.h"

namespace limpid {
namespace {

std::string words_of(const FieldInfo& field) {
  return join({field.choices.begin(), field.choices.end()});
}

std::string expected_of(const FieldInfo& field) {
  switch (field.kind) {
    case FieldKind::kReal:
      return field.range.min == kFinite.min ? detail::range_text(field.range, "") : "a number";
    case FieldKind::kColor:
      return "three numbers [r, g, b]";
    case FieldKind::kChoice:
      return "one of " + words_of(field);
    case FieldKind::kText:
      return "a string";
    case FieldKind::kCountOrWord:
      return "a whole number or one of " + words_of(field);
    case FieldKind::kTable:
      return "a list of " + columns_text(field);
    case FieldKind::kDirection:
      return "a list of 3 numbers";
    case FieldKind::kMatrix:
      return "a list of 4 rows of 4 numbers";
    case FieldKind::kFile:
      return "FILE";
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

std::string_view without_quotes(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? trimmed(text.substr(1, text.size() - 2)) : text;
}

/// The numbers of a text in TOML's syntax: `.5` becomes `0.5`, `1.` `1.0` and `007` `7`.
std::string with_toml_numbers(std::string_view text) {
  const auto digit = [&](std::size_t i) {
    return i < text.size() && text[i] >= '0' && text[i] <= '9';
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool point = text[i] == '.';
    const bool begins = result.empty() || std::strchr(" ,[+-", result.back());
    const bool before = i > 0 && digit(i - 1);
    if (point && !before && digit(i + 1)) result += '0';
    if (!(begins && text[i] == '0' && digit(i + 1))) result += text[i];
    if (point && before && !digit(i + 1)) result += '0';
  }
  return result;
}

TomlNode node_of_setting(std::string_view text, const FieldInfo& field) {
  TomlNode word;
  word.kind = TomlNode::Kind::kText;
  word.text = without_quotes(text);
  if (field.kind == FieldKind::kChoice || field.kind == FieldKind::kText) return word;
  std::string value = with_toml_numbers(text);
  if (field.kind == FieldKind::kColor && !text.starts_with('[')) value = "[" + value + "]";
  try {
    const TomlNode root = parse_toml_text("value = " + value, "");
    const bool fits = field.kind != FieldKind::kCountOrWord || is_number(root.items[0]);
    if (root.items.size() == 1 && fits) return root.items[0];
  } catch (const Error&) {
    // Invalid TOML counts as a word, which fields of numbers refuse.
  }
  return word;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

Value value_of(const TomlNode& node, const FieldInfo& field) {
  switch (field.kind) {
    case FieldKind::kReal:
      if (is_number(node)) return node.number;
      break;
    case FieldKind::kColor:
      if (is_list_of_numbers(node) && node.items.size() == 3) {
        return Rgb<double>{node.items[0].number, node.items[1].number, node.items[2].number};
      }
      break;
    case FieldKind::kCountOrWord:
      if (is_number(node)) return node.number;
      [[fallthrough]];
    case FieldKind::kChoice:
    case FieldKind::kText:
      if (node.kind == TomlNode::Kind::kText) return node.text;
      break;
    case FieldKind::kTable:
      if (const std::optional<Rows> rows = rows_of(node)) return *rows;
      break;
    case FieldKind::kDirection: {
      const std::vector<double> v = node.finite_numbers(3);
      return Rgb<double>{v[0], v[1], v[2]};
    }
    case FieldKind::kMatrix: {
      if (node.kind != TomlNode::Kind::kList || node.items.size() != 4) break;
      Rows rows;
      for (const TomlNode& row : node.items) rows.push_back(row.finite_numbers(4));
      return rows;
    }
    case FieldKind::kFile:
      if (!node.word().empty()) return node.text;
      break;
  }
  node.refuse(expected_of(field));
}

Value value_of_setting(std::string_view name, std::string_view text, const FieldInfo& field) {
  try {
    return value_of(node_of_setting(text, field), field);
  } catch (const Error&) {
    throw Error(std::string(name) + " = " + std::string(text) + ": expected " + expected_of(field),
                Fault::kUsage);
  }
}

}  // namespace limpid

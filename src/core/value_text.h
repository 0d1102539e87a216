#pragma once
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/core/field.h"

#include "core/toml_text.h"

namespace limpid {

/// A value of any kind as text, by functions for a number and a word.
template <class NumberText, class WordText>
std::string value_text(const Value& value, NumberText&& number_text, WordText&& word_text) {
  const auto list_text = [&](const auto& numbers) {
    std::vector<std::string> texts;
    for (const double x : numbers) texts.push_back(number_text(x));
    return "[" + join(texts) + "]";
  };
  if (const double* x = std::get_if<double>(&value)) return number_text(*x);
  if (const std::string* word = std::get_if<std::string>(&value)) return word_text(*word);
  if (const Rgb<double>* c = std::get_if<Rgb<double>>(&value)) {
    return list_text(std::vector{c->r, c->g, c->b});
  }
  std::vector<std::string> rows;
  for (const std::vector<double>& row : std::get<Rows>(value)) rows.push_back(list_text(row));
  return "[" + join(rows) + "]";
}

/// "name = value" with a line end, as in TOML files; it parses to the same bits.
inline std::string toml_line(std::string_view name, const Value& value) {
  const auto number = [](double x) { return toml_text(x); };
  const auto word = [](const std::string& text) { return toml_text(text); };
  return std::string(name) + " = " + value_text(value, number, word) + "\n";
}

}  // namespace limpid

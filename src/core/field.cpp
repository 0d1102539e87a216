#include "limpid/core/field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

#include "core/value_text.h"

namespace limpid {
namespace {

std::string number_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x);
  return text;
}

bool is_one_of(std::span<const std::string_view> words, const std::string* word) {
  return word && std::find(words.begin(), words.end(), *word) != words.end();
}

/// "; did you mean 'x'?" if the value is a word similar to a known one.
std::string slip(const std::string* word, const std::vector<std::string>& known) {
  return word ? did_you_mean(*word, known) : "";
}

}  // namespace

std::string to_string(const Value& value) {
  return value_text(value, number_text, [](const std::string& word) { return word; });
}

bool Condition::holds(std::string_view value, double number) const {
  if (key.empty() || (!or_above_zero.empty() && number > 0)) return true;
  return std::find(words.begin(), words.end(), value) != words.end();
}

std::string to_string(const Condition& condition) {
  std::vector<std::string> words;
  for (const std::string_view word : condition.words) {
    if (!word.empty()) words.emplace_back(word);
  }
  if (!condition.or_above_zero.empty()) {
    return std::string(condition.key) + " = " + join(words, " or ") + " or " +
           std::string(condition.or_above_zero) + " above 0";
  }
  return std::string(condition.key) + " = " + join(words, " or ");
}

std::string columns_text(const FieldInfo& field) {
  std::string text;
  for (std::size_t count = field.least_columns; count <= field.columns.size(); ++count) {
    const std::vector<std::string> names(field.columns.begin(), field.columns.begin() + count);
    text += (text.empty() ? "[" : " or [") + join(names) + "]";
  }
  return text;
}

namespace detail {

glm::dvec3 unit_direction(const Rgb<double>& v) {
  const glm::dvec3 direction(v.r, v.g, v.b);
  if (std::abs(glm::dot(direction, direction) - 1) < 1e-14) return direction;
  const double largest = std::max({std::abs(v.r), std::abs(v.g), std::abs(v.b)});
  return glm::normalize(direction / largest);  // squares of large numbers would overflow
}

glm::dmat4 matrix_of_rows(const Rows& rows) {
  glm::dmat4 matrix;  // GLM keeps columns
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) matrix[column][row] = rows[row][column];
  }
  return matrix;
}

Rows rows_of_matrix(const glm::dmat4& m) {
  Rows rows;
  for (int r = 0; r < 4; ++r) rows.push_back({m[0][r], m[1][r], m[2][r], m[3][r]});
  return rows;
}

std::string range_text(const Range& range, std::string_view unit) {
  std::string text = number_text(range.min) + " ... " + number_text(range.max);
  if (range.min == kFinite.min)
    text = std::isinf(range.max) ? "a number or inf" : "a finite number";
  if (!unit.empty()) text += " (" + std::string(unit) + ")";
  return text;
}

void check(std::string_view owner, const FieldInfo& field, const Value& value) {
  const auto fail = [&](const std::string& expected) {
    throw Error(std::string(owner) + "." + std::string(field.name) + " = " + to_string(value) +
                ": expected " + expected);
  };
  const Range range = field.range;
  const auto inside = [&](double x) { return x >= range.min && x <= range.max; };  // false for NaN
  const std::string* word = std::get_if<std::string>(&value);
  const double* x = std::get_if<double>(&value);
  const std::vector<std::string> words(field.choices.begin(), field.choices.end());
  switch (field.kind) {
    case FieldKind::kReal:
      if (!x || !inside(*x)) fail(range_text(range, field.unit));
      break;
    case FieldKind::kColor: {
      const Rgb<double>* c = std::get_if<Rgb<double>>(&value);
      if (!c || !inside(c->r) || !inside(c->g) || !inside(c->b)) {
        fail("three numbers, each " + range_text(range, field.unit));
      }
      break;
    }
    case FieldKind::kChoice:
      if (!is_one_of(field.choices, word)) {
        fail("one of " + join(words) + slip(word, words));
      }
      break;
    case FieldKind::kText:
      if (!word) fail("a string");
      break;
    case FieldKind::kCountOrWord:
      if (x ? !inside(*x) || *x != std::floor(*x) : !is_one_of(field.choices, word)) {
        fail("a whole number " + range_text(range, field.unit) + ", or " + join(words, " or ") +
             slip(word, words));
      }
      break;
    case FieldKind::kTable: {
      const Rows* rows = std::get_if<Rows>(&value);
      const auto fits = [&](const std::vector<double>& row) {
        return row.size() >= field.least_columns && row.size() <= field.columns.size() &&
               std::all_of(row.begin(), row.end(), inside);
      };
      if (!rows || !std::all_of(rows->begin(), rows->end(), fits)) {
        fail("a list of " + columns_text(field) + ", each number " + range_text(range, field.unit));
      }
      break;
    }
    case FieldKind::kDirection: {
      const Rgb<double>* v = std::get_if<Rgb<double>>(&value);
      if (!v || !inside(v->r) || !inside(v->g) || !inside(v->b) || *v == Rgb<double>{0, 0, 0}) {
        fail("a vector that is not zero");
      }
      break;
    }
    case FieldKind::kMatrix: {
      const Rows* rows = std::get_if<Rows>(&value);
      const auto fits = [&](const std::vector<double>& row) {
        return row.size() == 4 && std::all_of(row.begin(), row.end(), inside);
      };
      if (!rows || rows->size() != 4 || !std::all_of(rows->begin(), rows->end(), fits)) {
        fail("4 rows of 4 finite numbers");
      }
      break;
    }
    case FieldKind::kFile:
      if (!word || word->empty()) fail("FILE");
      break;
  }
}

}  // namespace detail
}  // namespace limpid

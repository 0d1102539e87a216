#include "limpid/core/field.h"

#include <cmath>
#include <cstdio>

namespace limpid {
namespace {

std::string number_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x);
  return text;
}

}  // namespace

std::string to_string(const Value& value) {
  if (const double* x = std::get_if<double>(&value)) return number_text(*x);
  if (const std::string* word = std::get_if<std::string>(&value)) return *word;
  const Rgb<double>& c = std::get<Rgb<double>>(value);
  return "[" + number_text(c.r) + ", " + number_text(c.g) + ", " + number_text(c.b) + "]";
}

namespace detail {

std::string range_text(const Range& range, std::string_view unit) {
  std::string text = number_text(range.min) + " ... " + number_text(range.max);
  if (!unit.empty()) text += " (" + std::string(unit) + ")";
  return text;
}

void check(const std::string& where, std::string_view unit, FieldKind kind, Range range,
           std::span<const std::string_view> choices, const Value& value) {
  const auto fail = [&](const std::string& expected) {
    throw Error(where + " = " + to_string(value) + ": expected " + expected);
  };
  const auto inside = [&](double x) { return x >= range.min && x <= range.max; };  // false for NaN
  switch (kind) {
    case FieldKind::kReal: {
      const double* x = std::get_if<double>(&value);
      if (!x || !inside(*x)) fail(range_text(range, unit));
      break;
    }
    case FieldKind::kColor: {
      const Rgb<double>* c = std::get_if<Rgb<double>>(&value);
      if (!c || !inside(c->r) || !inside(c->g) || !inside(c->b)) {
        fail("three numbers, each " + range_text(range, unit));
      }
      break;
    }
    case FieldKind::kChoice: {
      const std::string* word = std::get_if<std::string>(&value);
      std::vector<std::string> known(choices.begin(), choices.end());
      for (const std::string& name : known) {
        if (word && *word == name) return;
      }
      fail("one of " + join(known) + (word ? did_you_mean(*word, known) : ""));
      break;
    }
    case FieldKind::kText:
      if (!std::holds_alternative<std::string>(value)) fail("a text");
      break;
  }
}

}  // namespace detail
}  // namespace limpid

#pragma once
#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/error.h"
#include "limpid/core/vec.h"

/// @file
/// Parameters, declared once as data. A struct of parameters has its defaults as initialisers; a
/// table of Field has the name, unit, range and description of each parameter. Validation, `--set`,
/// scene and look files, `limpid operators` and the contract tests all read this table.
///
///     enum class Model { kPhong, kBlinnPhong };
///     struct Params { Model model = Model::kBlinnPhong; double power = 200; };
///     static constexpr std::string_view kModels[] = {"phong", "blinn_phong"};
///     static const Field<Params> kFields[] = {
///         choice<&Params::model, kModels>("model", "How the lobe is measured."),
///         real<&Params::power>("power", "", {0, 1e5}, "Exponent of the lobe; larger is sharper.")
///             .when("model", {"phong", "blinn_phong"}),
///     };

namespace limpid {

using Rows = std::vector<std::vector<double>>;

/// The value of a field in text files and on the command line: a number, a word, three numbers (a
/// color or a direction), or rows of numbers (a table or a matrix).
using Value = std::variant<double, std::string, Rgb<double>, Rows>;

std::string to_string(const Value& value);

/// Closed interval. A value outside it, or NaN, is refused.
struct Range {
  double min, max;
};

/// The range of all finite numbers.
inline constexpr Range kFinite{std::numeric_limits<double>::lowest(),
                               std::numeric_limits<double>::max()};

/// The condition under which a parameter has an effect: another parameter of the same struct,
/// `key`, has one of these words. If `key` is a number (or a count or word), its text is compared.
struct Condition {
  static constexpr std::size_t kMost = 12;
  std::string_view key;  ///< the other parameter; "" for no condition
  std::array<std::string_view, kMost> words{};
  /// setting the parameter sets `key` to the first word, if it has none of them
  bool follows = false;
  /// a number above 0 in this parameter suffices, too; "" for none
  std::string_view or_above_zero{};

  /// `value` is that of `key`, `number` that of or_above_zero.
  bool holds(std::string_view value, double number = 0) const;
};
/// "model = four_maps or slopes", "model = two_flows or wind above 0".
std::string to_string(const Condition& condition);

enum class FieldKind {
  kReal,
  kChoice,
  kColor,
  kText,
  kCountOrWord,
  kTable,
  kDirection,  ///< three finite numbers, not all zero; stored as a unit vector
  kMatrix,     ///< four rows of four finite numbers, for column vectors
  kFile,       ///< the name of a file, not empty
};

/// The declaration of a parameter, without the type of its struct.
struct FieldInfo {
  std::string_view name;
  std::string_view unit;  ///< "" for a pure number
  FieldKind kind;
  Range range;                                ///< of each number
  std::span<const std::string_view> choices;  ///< kChoice, in the order of the enum; kCountOrWord
  std::span<const std::string_view> columns;  ///< kTable: names of the numbers of a row
  std::size_t least_columns;                  ///< kTable: the number of required columns
  std::string_view about;                     ///< one sentence
  std::array<Condition, 2> used_when{};       ///< unless both hold, the parameter is not read
};

/// The columns of a row by their names: "[a, b] or [a, b, c]".
std::string columns_text(const FieldInfo& field);

template <class P>
struct Field : FieldInfo {
  Value (*get)(const P&);
  void (*set)(P&, const Value&);     ///< without a check: call assign() instead
  const void* (*address)(const P&);  ///< of the member

  /// The same field, but read only if the parameter `key` has one of these words. At most two
  /// conditions.
  constexpr Field when(std::string_view key, std::initializer_list<std::string_view> words) const {
    Field field = *this;
    Condition& free = field.used_when[field.used_when[0].key.empty() ? 0 : 1];
    free.key = key;
    std::size_t next = 0;
    for (const std::string_view word : words) free.words[next++] = word;
    return field;
  }
  /// The same field, but its last condition also holds if the number `key` is above 0.
  constexpr Field or_above_zero(std::string_view key) const {
    Field field = *this;
    field.used_when[field.used_when[1].key.empty() ? 0 : 1].or_above_zero = key;
    return field;
  }
  /// The same field; setting this parameter sets the parameter `key` to `word`, too.
  constexpr Field brings(std::string_view key, std::string_view word) const {
    Field field = when(key, {word});
    for (Condition& condition : field.used_when) condition.follows |= condition.key == key;
    return field;
  }
};

namespace detail {
template <class T>
struct MemberOf;
template <class P, class T>
struct MemberOf<T P::*> {
  using Params = P;
};
template <auto M>
using ParamsOf = typename MemberOf<decltype(M)>::Params;

std::string range_text(const Range& range, std::string_view unit);

/// `v` at length 1. A vector that is unit to rounding stays unchanged, so that a direction that was
/// written to a file reads back the same.
glm::dvec3 unit_direction(const Rgb<double>& v);
glm::dmat4 matrix_of_rows(const Rows& rows);
Rows rows_of_matrix(const glm::dmat4& matrix);

/// Throws Error, with a message that begins with "owner.name", unless `value` fits the declaration.
void check(std::string_view owner, const FieldInfo& field, const Value& value);
}  // namespace detail

template <auto M>
constexpr Field<detail::ParamsOf<M>> real(std::string_view name, std::string_view unit, Range range,
                                          std::string_view about) {
  using P = detail::ParamsOf<M>;
  return {{name, unit, FieldKind::kReal, range, {}, {}, 0, about},
          [](const P& p) -> Value { return p.*M; },
          [](P& p, const Value& v) { p.*M = std::get<double>(v); },
          [](const P& p) -> const void* { return &(p.*M); }};
}

template <auto M>
constexpr Field<detail::ParamsOf<M>> color(std::string_view name, std::string_view unit,
                                           Range range, std::string_view about) {
  using P = detail::ParamsOf<M>;
  return {{name, unit, FieldKind::kColor, range, {}, {}, 0, about},
          [](const P& p) -> Value { return p.*M; },
          [](P& p, const Value& v) { p.*M = std::get<Rgb<double>>(v); },
          [](const P& p) -> const void* { return &(p.*M); }};
}

template <auto M>
constexpr Field<detail::ParamsOf<M>> text(std::string_view name, std::string_view about) {
  using P = detail::ParamsOf<M>;
  return {{name, "", FieldKind::kText, {}, {}, {}, 0, about},
          [](const P& p) -> Value { return p.*M; },
          [](P& p, const Value& v) { p.*M = std::get<std::string>(v); },
          [](const P& p) -> const void* { return &(p.*M); }};
}

/// For an enum that counts from 0; `Words[i]` is the word for the value i. `Words` is a static
/// array. A value without a word reads as its number, which detail::check() refuses.
template <auto M, const auto& Words>
constexpr Field<detail::ParamsOf<M>> choice(std::string_view name, std::string_view about) {
  using P = detail::ParamsOf<M>;
  using E = std::remove_cvref_t<decltype(std::declval<P>().*M)>;
  return {{name, "", FieldKind::kChoice, {}, Words, {}, 0, about},
          [](const P& p) -> Value {
            const auto value = static_cast<std::size_t>(p.*M);
            if (value >= std::size(Words)) return std::to_string(static_cast<int>(p.*M));
            return std::string(Words[value]);
          },
          [](P& p, const Value& v) {
            const std::string& word = std::get<std::string>(v);
            for (std::size_t i = 0; i < std::size(Words); ++i) {
              if (Words[i] == word) p.*M = static_cast<E>(i);
            }
          },
          [](const P& p) -> const void* { return &(p.*M); }};
}

/// An int: a count, or -1 - i for the word `Words[i]`, as in `steps = 4` or `steps = "march"`.
/// `Words` is a static array; the range begins at 0 or above.
template <auto M, const auto& Words>
constexpr Field<detail::ParamsOf<M>> count_or_word(std::string_view name, std::string_view unit,
                                                   Range range, std::string_view about) {
  using P = detail::ParamsOf<M>;
  constexpr int kWords = static_cast<int>(std::size(Words));
  return {{name, unit, FieldKind::kCountOrWord, range, Words, {}, 0, about},
          [](const P& p) -> Value {
            const bool word = p.*M < 0 && p.*M >= -kWords;
            if (word) return std::string(Words[static_cast<std::size_t>(-1 - p.*M)]);
            return static_cast<double>(p.*M);
          },
          [](P& p, const Value& v) {
            if (const double* count = std::get_if<double>(&v)) p.*M = static_cast<int>(*count);
            for (int i = 0; i < kWords; ++i) {
              if (v == Value(std::string(Words[i]))) p.*M = -1 - i;
            }
          },
          [](const P& p) -> const void* { return &(p.*M); }};
}

/// A vector of rows of numbers, each number in the range: `waves = [[0.05, 1, 0, 0]]`. The type of
/// a row has kColumns and kLeastColumns, from_row() and to_row() (see SineWave).
template <auto M>
constexpr Field<detail::ParamsOf<M>> table(std::string_view name, std::string_view unit,
                                           Range range, std::string_view about) {
  using P = detail::ParamsOf<M>;
  using Row = typename std::remove_cvref_t<decltype(std::declval<P>().*M)>::value_type;
  return {{name, unit, FieldKind::kTable, range, {}, Row::kColumns, Row::kLeastColumns, about},
          [](const P& p) -> Value {
            Rows rows;
            for (const Row& row : p.*M) rows.push_back(row.to_row());
            return rows;
          },
          [](P& p, const Value& v) {
            (p.*M).clear();
            for (const std::vector<double>& row : std::get<Rows>(v)) {
              (p.*M).push_back(Row::from_row(row));
            }
          },
          [](const P& p) -> const void* { return &(p.*M); }};
}

/// A member of type glm::dvec3.
template <auto M>
constexpr Field<detail::ParamsOf<M>> direction(std::string_view name, std::string_view about) {
  using P = detail::ParamsOf<M>;
  return {{name, "", FieldKind::kDirection, kFinite, {}, {}, 0, about},
          [](const P& p) -> Value {
            return Rgb<double>{(p.*M).x, (p.*M).y, (p.*M).z};
          },
          [](P& p, const Value& v) { p.*M = detail::unit_direction(std::get<Rgb<double>>(v)); },
          [](const P& p) -> const void* { return &(p.*M); }};
}

/// A member of type glm::dmat4.
template <auto M>
constexpr Field<detail::ParamsOf<M>> matrix(std::string_view name, std::string_view about) {
  using P = detail::ParamsOf<M>;
  return {{name, "", FieldKind::kMatrix, kFinite, {}, {}, 0, about},
          [](const P& p) -> Value { return detail::rows_of_matrix(p.*M); },
          [](P& p, const Value& v) { p.*M = detail::matrix_of_rows(std::get<Rows>(v)); },
          [](const P& p) -> const void* { return &(p.*M); }};
}

/// A member of type std::filesystem::path.
template <auto M>
constexpr Field<detail::ParamsOf<M>> file(std::string_view name, std::string_view about) {
  using P = detail::ParamsOf<M>;
  return {{name, "", FieldKind::kFile, {}, {}, {}, 0, about},
          [](const P& p) -> Value { return (p.*M).string(); },
          [](P& p, const Value& v) { p.*M = std::get<std::string>(v); },
          [](const P& p) -> const void* { return &(p.*M); }};
}

/// Sets one parameter after checking kind, range and NaN. Throws Error with `owner.field`, the
/// value and the expected value in its message, and then leaves `params` unchanged.
template <class P>
void assign(std::string_view owner, const Field<P>& field, P& params, const Value& value) {
  detail::check(owner, field, value);
  field.set(params, value);
}

/// Throws Error at the first parameter outside its declared range.
template <class P>
void validate(std::string_view owner, std::span<const Field<P>> fields, const P& params) {
  for (const Field<P>& field : fields) detail::check(owner, field, field.get(params));
}

}  // namespace limpid

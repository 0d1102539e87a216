#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/core/vec.h"

/// Parameters declared once, as data. A struct of parameters holds its defaults as initialisers; a
/// table of Field says, for each, its name, unit, range and one sentence. Validation, `--set`,
/// scene and look files, `limpid operators` and the contract tests all read that table and nothing
/// else.
///
///   enum class Model { kPhong, kBlinnPhong };
///   struct Params { Model model = Model::kBlinnPhong; double power = 200; };
///   static constexpr std::string_view kModels[] = {"phong", "blinn_phong"};
///   static const Field<Params> kFields[] = {
///       choice<&Params::model, kModels>("model", "How the lobe is measured."),
///       real<&Params::power>("power", "", {0, 1e5}, "Exponent of the lobe; larger is sharper."),
///   };

namespace limpid {

/// What a field holds, as text files and the command line see it: a number, a word, or a color.
using Value = std::variant<double, std::string, Rgb<double>>;

std::string to_string(const Value& value);

/// Closed interval. A value outside it, or NaN, is refused.
struct Range {
  double min, max;
};

enum class FieldKind { kReal, kChoice, kColor, kText };

template <class P>
struct Field {
  std::string_view name;
  std::string_view unit;  ///< "" for a pure number
  FieldKind kind;
  Range range;                                ///< kReal, and each channel of kColor
  std::span<const std::string_view> choices;  ///< kChoice: the words, in the order of the enum
  std::string_view about;                     ///< one sentence
  Value (*get)(const P&);
  void (*set)(P&, const Value&);  ///< unchecked: go through assign()
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

/// Throws Error, beginning with `where` = "operator.parameter", unless `value` fits the
/// declaration.
void check(const std::string& where, std::string_view unit, FieldKind kind, Range range,
           std::span<const std::string_view> choices, const Value& value);
}  // namespace detail

template <auto M>
constexpr Field<detail::ParamsOf<M>> real(std::string_view name, std::string_view unit, Range range,
                                          std::string_view about) {
  using P = detail::ParamsOf<M>;
  return {name,
          unit,
          FieldKind::kReal,
          range,
          {},
          about,
          [](const P& p) -> Value { return p.*M; },
          [](P& p, const Value& v) { p.*M = std::get<double>(v); }};
}

template <auto M>
constexpr Field<detail::ParamsOf<M>> color(std::string_view name, std::string_view unit,
                                           Range range, std::string_view about) {
  using P = detail::ParamsOf<M>;
  return {name,
          unit,
          FieldKind::kColor,
          range,
          {},
          about,
          [](const P& p) -> Value { return p.*M; },
          [](P& p, const Value& v) { p.*M = std::get<Rgb<double>>(v); }};
}

template <auto M>
constexpr Field<detail::ParamsOf<M>> text(std::string_view name, std::string_view about) {
  using P = detail::ParamsOf<M>;
  return {name,
          "",
          FieldKind::kText,
          {},
          {},
          about,
          [](const P& p) -> Value { return p.*M; },
          [](P& p, const Value& v) { p.*M = std::get<std::string>(v); }};
}

/// For an enum that counts from 0; `Words[i]` is the word for the value i. `Words` is a static
/// array.
template <auto M, const auto& Words>
constexpr Field<detail::ParamsOf<M>> choice(std::string_view name, std::string_view about) {
  using P = detail::ParamsOf<M>;
  using E = std::remove_cvref_t<decltype(std::declval<P>().*M)>;
  return {name,
          "",
          FieldKind::kChoice,
          {},
          Words,
          about,
          [](const P& p) -> Value { return std::string(Words[static_cast<std::size_t>(p.*M)]); },
          [](P& p, const Value& v) {
            const std::string& word = std::get<std::string>(v);
            for (std::size_t i = 0; i < std::size(Words); ++i) {
              if (Words[i] == word) p.*M = static_cast<E>(i);
            }
          }};
}

/// Sets one parameter after checking kind, range and NaN. Throws Error that names `owner.field`,
/// the value and what was expected; `params` is unchanged then.
template <class P>
void assign(std::string_view owner, const Field<P>& field, P& params, const Value& value) {
  detail::check(std::string(owner) + "." + std::string(field.name), field.unit, field.kind,
                field.range, field.choices, value);
  field.set(params, value);
}

/// Throws Error at the first parameter outside its declared range.
template <class P>
void validate(std::string_view owner, std::span<const Field<P>> fields, const P& params) {
  for (const Field<P>& field : fields) {
    detail::check(std::string(owner) + "." + std::string(field.name), field.unit, field.kind,
                  field.range, field.choices, field.get(params));
  }
}

}  // namespace limpid

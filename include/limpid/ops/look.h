#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "limpid/ops/chain.h"

namespace limpid {

/// Parameters of the water as a whole: table `water` of a look.
struct Water {
  /// Pixels that an object in front of the water covers partly (complete/edges.h): mixed, or wet or
  /// dry as a whole by their depth.
  enum class Edges { kMixed, kHard };
  double ior = 1.333;
  Edges edges = Edges::kMixed;

  static constexpr std::string_view kName = "water";
  static constexpr std::string_view kAbout = "Index of refraction, and edges of objects.";
  static std::span<const Field<Water>> fields();
};

/// All parameters of the water.
struct Look {
  std::string name;
  Water water;
  Chain::AllParams operators;
  std::string file;                     ///< the file of the look, absolute, or ""
  std::string about = {};               ///< a sentence on its purpose, or ""
  std::vector<std::string> bases = {};  ///< files of its base looks, absolute

  template <class Op>
  typename Op::Params& of() {
    return std::get<typename Op::Params>(operators);
  }
  template <class Op>
  const typename Op::Params& of() const {
    return std::get<typename Op::Params>(operators);
  }

  /// Sets `table.key`, as in set("refraction", "strength", 0.03). Dependent parameters (see
  /// Condition::follows) are set, too: an absorption makes the water_type `custom`, and a named
  /// type that is set afterwards replaces it. Throws Error with the nearest name for an unknown
  /// table or key, and for a value that its declaration refuses.
  void set(std::string_view table, std::string_view key, const Value& value);

  /// Throws Error at the first parameter outside its range (NaN included).
  void validate() const;
};

/// One parameter as data, without its struct: for listings and for text that records a look.
struct Parameter : FieldInfo {
  std::string_view table;
  Value value;
};

/// Every parameter of the look with its value, in the order of `water` and the chain.
std::vector<Parameter> parameters(const Look& look);

/// A sentence for each parameter that is not at its default and has no effect because of another
/// one (FieldInfo::used_when).
std::vector<std::string> unread_settings(const Look& look);

/// Sets those parameters to their defaults that have no effect in `look`, but have one in `base`,
/// at the same value: for a look made of `base` by changes, of which unread_settings() then speaks
/// alone. No effect changes.
void forget_unread(Look& look, const Look& base);

/// The look as a TOML text that reads back as the same look.
std::string to_toml(const Look& look);

}  // namespace limpid

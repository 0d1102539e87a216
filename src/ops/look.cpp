#include "limpid/ops/look.h"

#include "limpid/core/error.h"

#include "core/value_text.h"

namespace limpid {
namespace {

constexpr std::string_view kEdges[] = {"mixed", "hard"};

constexpr Field<Water> kWaterFields[] = {
    real<&Water::ior>("ior", "", {1, 4}, "Index of refraction of the water against air."),
    choice<&Water::edges, kEdges>("edges",
                                  "Pixels that an object in front of the water covers partly: "
                                  "mixed, or wet or dry as a whole."),
};

/// Calls visit(name, fields, params) for `water` and every operator.
template <class L, class Visit>
void for_each_table(L& look, Visit&& visit) {
  visit(Water::kName, Water::fields(), look.water);
  Chain::for_each([&]<class Op, int>() { visit(Op::kName, Op::fields(), look.template of<Op>()); });
}

/// Sets the parameters that follow from `field`.
template <class P>
void follow(std::span<const Field<P>> fields, const Field<P>& field, P& params) {
  for (const Condition& condition : field.used_when) {
    if (!condition.follows) continue;
    for (const Field<P>& other : fields) {
      if (other.name != condition.key || condition.holds(to_string(other.get(params)))) continue;
      other.set(params, std::string(condition.words.front()));
    }
  }
}

/// Another parameter of the table, or null.
const Parameter* beside(const std::vector<Parameter>& all, const Parameter& p,
                        std::string_view key) {
  for (const Parameter& other : all) {
    if (other.table == p.table && other.name == key) return &other;
  }
  return nullptr;
}

bool holds(const Condition& condition, const std::vector<Parameter>& all, const Parameter& p) {
  const Parameter* other = beside(all, p, condition.key);
  const Parameter* number = beside(all, p, condition.or_above_zero);
  return !other ||
         condition.holds(to_string(other->value), number ? std::get<double>(number->value) : 0);
}

/// The first condition because of which a parameter has no effect, or null.
const Condition* unmet(const std::vector<Parameter>& all, const Parameter& p) {
  for (const Condition& condition : p.used_when) {
    if (!holds(condition, all, p)) return &condition;
  }
  return nullptr;
}

}  // namespace

std::span<const Field<Water>> Water::fields() { return kWaterFields; }

void Look::set(std::string_view table, std::string_view key, const Value& value) {
  std::vector<std::string> tables, keys;
  bool table_found = false, key_found = false;
  for_each_table(*this, [&](std::string_view owner, auto fields, auto& params) {
    tables.emplace_back(owner);
    if (owner != table) return;
    table_found = true;
    for (const auto& field : fields) {
      keys.emplace_back(field.name);
      if (field.name != key) continue;
      key_found = true;
      assign(owner, field, params, value);
      follow(fields, field, params);
    }
  });
  if (!table_found) {
    throw Error("unknown table '" + std::string(table) + "': expected one of " + join(tables) +
                did_you_mean(table, tables));
  }
  if (!key_found) {
    throw Error("unknown key '" + std::string(table) + "." + std::string(key) +
                "': expected one of " + join(keys) + did_you_mean(key, keys));
  }
}

void Look::validate() const {
  for_each_table(*this, [](std::string_view owner, auto fields, const auto& params) {
    limpid::validate(owner, fields, params);
  });
}

std::vector<Parameter> parameters(const Look& look) {
  std::vector<Parameter> all;
  for_each_table(look, [&](std::string_view table, auto fields, const auto& params) {
    for (const auto& field : fields) all.push_back({field, table, field.get(params)});
  });
  return all;
}

std::vector<std::string> unread_settings(const Look& look) {
  std::vector<std::string> sentences;
  const std::vector<Parameter> all = parameters(look), defaults = parameters(Look{});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Parameter& p = all[i];
    if (p.value == defaults[i].value) continue;
    const Condition* condition = unmet(all, p);
    if (!condition) continue;
    const Parameter* other = beside(all, p, condition->key);
    sentences.push_back(std::string(p.table) + "." + std::string(p.name) + " = " +
                        to_string(p.value) + " changes nothing: " + std::string(other->name) +
                        " is " + to_string(other->value) + ", expected " + to_string(*condition));
  }
  return sentences;
}

void forget_unread(Look& look, const Look& base) {
  const std::vector<Parameter> all = parameters(look), before = parameters(base);
  const std::vector<Parameter> defaults = parameters(Look{});
  std::size_t i = 0;
  for_each_table(look, [&](std::string_view, auto fields, auto& params) {
    for (const auto& field : fields) {
      const bool kept = all[i].value == before[i].value;
      if (kept && unmet(all, all[i]) && !unmet(before, before[i])) {
        field.set(params, defaults[i].value);
      }
      ++i;
    }
  });
}

std::string to_toml(const Look& look) {
  std::string text;
  std::string_view table;
  for (const Parameter& p : parameters(look)) {
    if (p.table != table) text += (text.empty() ? "[" : "\n[") + std::string(p.table) + "]\n";
    table = p.table;
    text += toml_line(p.name, p.value);
  }
  return text;
}

}  // namespace limpid

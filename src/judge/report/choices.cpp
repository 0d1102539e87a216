#include "judge/report/choices.h"

#include "limpid/ops/chain.h"

namespace limpid {
namespace {

/// Parameters that are no alternative models of one effect: the type of water, the source of
/// normals, and an article's blend without a physical meaning.
bool is_model(const Parameter& p) {
  if (p.kind != FieldKind::kChoice && p.kind != FieldKind::kCountOrWord) return false;
  return p.table != WaveNormals::kName && p.table != Penetration::kName && p.name != "water_type";
}

std::vector<Value> values_of(const Parameter& p) {
  std::vector<Value> values;
  if (p.kind == FieldKind::kCountOrWord) {
    for (const double count : {0.0, 1.0, 2.0, 4.0}) values.emplace_back(count);
  }
  for (std::string_view word : p.choices) values.emplace_back(std::string(word));
  return values;
}

}  // namespace

std::vector<Choice> choices_of(const Look& look) {
  std::vector<Choice> list;
  const auto add = [&](std::string_view table, std::string_view key, const Value& value) {
    Look changed = look;
    changed.set(table, key, value);
    list.push_back({std::string(table) + "." + std::string(key), to_string(value), changed});
  };
  for (const Parameter& p : parameters(look)) {
    if (!is_model(p)) continue;
    for (const Value& value : values_of(p)) {
      if (value != p.value) add(p.table, p.name, value);
    }
  }
  // Effects that a number turns off.
  add(PrismSplit::kName, "gain", 0.0);
  add(WaterShadow::kName, "strength", 0.0);
  add(SunHighlight::kName, "strength", 0.0);
  return list;
}

}  // namespace limpid

#include <algorithm>
#include <cstdio>

#include "limpid/files/text/scene_keys.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

#include "data_folder.h"
#include "plate/layer_rules.h"
#include "verbs.h"

namespace limpid::tool {
namespace {

std::string state_text(StateSet set) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::size(kStatePartNames); ++i) {
    if (set.has(static_cast<StatePart>(i))) names.emplace_back(kStatePartNames[i]);
  }
  return names.empty() ? "-" : join(names);
}

/// `either`: the text between the words of a choice.
std::string allowed_text(const FieldInfo& p, const std::string& either) {
  const std::string words = join({p.choices.begin(), p.choices.end()}, either);
  const std::string range = detail::range_text(p.range, p.unit);
  switch (p.kind) {
    case FieldKind::kReal:
    case FieldKind::kColor:
      return range;
    case FieldKind::kChoice:
      return words;
    case FieldKind::kText:
      return {};
    case FieldKind::kCountOrWord:
      return range + either + words;
    case FieldKind::kTable:
      return "[" + columns_text(p) + ", ...], each number " + range;
    case FieldKind::kDirection:
      return "[x, y, z], not all zero";
    case FieldKind::kMatrix:
      return "4 rows of 4 numbers, for column vectors";
    case FieldKind::kFile:
      return "FILE";
  }
  return {};
}

/// "; with model = linear", or "" for a parameter that is always read.
std::string used_text(const Parameter& p) {
  std::vector<std::string> conditions;
  for (const Condition& condition : p.used_when) {
    if (!condition.key.empty()) conditions.push_back(to_string(condition));
  }
  return conditions.empty() ? "" : "; with " + join(conditions, " and ");
}

void print_parameter(const Parameter& p) {
  const std::string allowed = allowed_text(p, " | ") + used_text(p);
  std::printf("  %-12s = %-20s %s\n", std::string(p.name).c_str(), to_string(p.value).c_str(),
              std::string(p.about).c_str());
  const std::size_t first = allowed.starts_with(';') ? 2 : 0;  // a text may hold anything
  if (!allowed.empty()) std::printf("  %-12s   %-20s %s\n", "", "", allowed.c_str() + first);
}

void print_table(const std::vector<Parameter>& all, std::string_view table) {
  for (const Parameter& p : all) {
    if (p.table == table) print_parameter(p);
  }
}

/// The tables of docs/files.md, in the page's format.
int print_scene_tables() {
  const char* separator = "";
  for (const SceneTable& table : scene_tables()) {
    std::printf("%s### [%s]\n\n%s\n\n| key | default | values | meaning |\n|---|---|---|---|\n",
                separator, std::string(table.name).c_str(), std::string(table.about).c_str());
    for (const SceneKey& key : table.keys) {
      std::printf("| `%s` | %s | %s | %s |\n", std::string(key.name).c_str(), key.unset.c_str(),
                  allowed_text(key, ", ").c_str(), std::string(key.about).c_str());
    }
    separator = "\n";
  }
  return 0;
}

constexpr std::string_view by_name_of(LayerRank rank) {
  switch (rank) {
    case LayerRank::kOwn:
      return "the whole layer";
    case LayerRank::kLayer:
      return "the layer's last words";
    case LayerRank::kFileName:
      return "the file's name";
    case LayerRank::kBare:
      return "no layer";
    case LayerRank::kPart:
      return "channels without a layer, in a part with another name";
    case LayerRank::kGiven:
      return "a file given for the buffer";
  }
  return {};
}

/// "a|b" as "`a`, `b`".
std::string alternatives_text(std::string_view text) {
  std::string words;
  for (const char c : text) words += c == '|' ? "`, `" : std::string(1, c);
  return words.empty() ? "" : "`" + words + "`";
}

int print_layer_rules() {
  std::printf("| buffer | found by | names | channels | source |\n|---|---|---|---|---|\n");
  for (const LayerRule& rule : layer_rules()) {
    std::printf("| %s | %s | %s | %s | %s |\n",
                rule.role.empty() ? "none" : alternatives_text(rule.role).c_str(),
                std::string(by_name_of(rule.rank)).c_str(), alternatives_text(rule.layer).c_str(),
                alternatives_text(rule.channels).c_str(), std::string(rule.programs).c_str());
  }
  return 0;
}

int print_aovs() {
  std::printf("| AOV | channels | stored as | several samples | meaning |\n");
  std::printf("|---|---|---|---|---|\n");
  for (const AovInfo& aov : aovs()) {
    std::printf("| `%s` | %s | %s | %s | %s |\n", std::string(aov.name).c_str(),
                std::string(aov.suffixes).c_str(), aov.storage == Storage::kHalf ? "half" : "float",
                aov.filter == Filter::kMean ? "mean" : "middle sample",
                std::string(aov.about).c_str());
  }
  return 0;
}

}  // namespace

int operators_verb(const OperatorsArguments& a) {
  if (a.scene) return print_scene_tables();
  if (a.layers) return print_layer_rules();
  if (a.aovs) return print_aovs();
  const Look look = a.look.empty() ? Look{} : look_for(a.look);
  const std::vector<Parameter> all = parameters(look);
  std::vector<std::string> names{std::string(Water::kName)};
  for (const OperatorInfo& op : operators()) names.emplace_back(op.name);

  if (a.name.empty()) {
    std::printf(
        "Operators in the order in which they run, with the buffers they read (taps), and the "
        "state they use and make:\n");
    for (const OperatorInfo& op : operators()) {
      std::printf("\n%-19s %s\n", std::string(op.name).c_str(), std::string(op.about).c_str());
      std::printf("%-19s   taps %s; uses %s; makes %s\n", "", roles_text(op.reads(look)).c_str(),
                  state_text(op.uses).c_str(), state_text(op.makes).c_str());
      print_table(all, op.name);
    }
    std::printf("\n%-19s %s\n", std::string(Water::kName).c_str(),
                std::string(Water::kAbout).c_str());
    print_table(all, Water::kName);
    return 0;
  }
  if (std::find(names.begin(), names.end(), a.name) == names.end()) {
    const char* what =
        a.verbs.empty() ? "' is not an operator" : "' is neither a verb nor an operator";
    names.insert(names.begin(), a.verbs.begin(), a.verbs.end());
    throw Error(
        "'" + a.name + what + ": expected one of " + join(names) + did_you_mean(a.name, names),
        Fault::kUsage);
  }
  std::printf("[%s]\n", a.name.c_str());
  print_table(all, a.name);
  return 0;
}

}  // namespace limpid::tool

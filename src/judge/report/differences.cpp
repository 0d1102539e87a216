#include "judge/report/differences.h"

#include "limpid/core/error.h"

namespace limpid {
namespace {

/// The words for an operator's model, compared with another look.
std::string other_words(const Plan& plan, const Plan& judge, std::string_view table) {
  const std::vector<Parameter> ours = parameters(plan.look), theirs = parameters(judge.look);
  std::vector<std::string> words;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const Parameter& p = ours[i];
    const bool names_model = p.kind == FieldKind::kChoice || p.kind == FieldKind::kCountOrWord;
    if (p.table != table || !names_model || p.value == theirs[i].value) continue;
    words.push_back(std::string(p.name) + " " + to_string(p.value));
  }
  return join(words);
}

}  // namespace

std::vector<std::string> differences(const Plan& plan, const Plan& judge) {
  std::vector<std::string> phrases;
  for (int i = 0; i < Chain::kCount; ++i) {
    const std::string name(plan.operators[i].name);
    if (!plan.keeps(i) && judge.keeps(i)) phrases.push_back("no " + name);
    if (plan.keeps(i) && !judge.keeps(i)) phrases.push_back("also " + name);
    if (!plan.keeps(i) || !judge.keeps(i)) continue;
    const std::string words = other_words(plan, judge, name);
    if (!words.empty()) phrases.push_back(name + ": " + words);
  }
  return phrases;
}

}  // namespace limpid

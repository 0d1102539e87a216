#include "plan/rules.h"

#include <array>

#include "limpid/core/error.h"

#include "plan/cell_rules.h"
#include "plan/operator_table.h"

namespace limpid {
namespace {

void skip(PlannedOperator& op, Verdict verdict, std::string reason) {
  op.verdict = verdict;
  op.reason = std::move(reason);
}

void add_reason(PlannedOperator& op, std::string_view reason) {
  op.reason += (op.reason.empty() ? "" : "; ") + std::string(reason);
}

AtHand at_hand(const Inputs& inputs) { return {inputs.planes, inputs.environment, inputs.waves}; }

/// Calls visit(operator, its entry) for the operators that are kept, in order.
template <class Visit>
void for_each_kept(Plan& plan, Visit&& visit) {
  for (int i = 0; i < Chain::kCount; ++i) {
    const auto index = static_cast<std::size_t>(i);
    if (plan.keeps(i)) visit(plan.operators[index], operator_table()[index]);
  }
}

// The rules of a plan. Each reads the whole plan, changes it, and leaves its reason with the
// operator.

void take_better_input(Plan& plan, const Inputs& inputs) {
  for_each_kept(plan, [&](PlannedOperator& op, const OperatorEntry& entry) {
    const std::string_view reason = entry.prefer(plan.look, at_hand(inputs));
    if (!reason.empty()) op.reason = reason;
  });
}

void skip_absent_input(Plan& plan, const Inputs& inputs) {
  for_each_kept(plan, [&](PlannedOperator& op, const OperatorEntry& entry) {
    const Needs needs = entry.needs(plan.look);
    std::vector<std::string> absent;
    for (const Role& role : roles()) {
      const PlaneSet wanted = needs.planes & role.planes();
      if (!inputs.planes.covers(wanted)) absent.emplace_back(role.name);
    }
    if (needs.sun && !inputs.sun) absent.emplace_back("sun");
    if (needs.wave_map && !inputs.wave_map) absent.emplace_back("normal map");
    if (needs.environment && !inputs.environment) absent.emplace_back("environment");
    if (!absent.empty()) skip(op, Verdict::kAbsent, "no " + join(absent, ", no "));
  });
}

/// In chain order, because leaving out an operator can make a later one neutral. Neutral refers to
/// the picture: an operator that makes the path stays if the path is an output, and makes no later
/// operator change the picture.
void skip_neutral(Plan& plan, const Inputs&) {
  StateSet made;
  for_each_kept(plan, [&](PlannedOperator& op, const OperatorEntry& entry) {
    const bool measured = entry.makes.has(StatePart::kPath) && plan.outputs.has(StatePart::kPath);
    if (!entry.neutral(plan.look, made)) {
      made = made | entry.makes;
    } else if (!measured) {
      skip(op, Verdict::kNeutral, "its parameters change nothing here");
    }
  });
}

/// Backwards from the outputs.
void skip_unread_operator(Plan& plan, const Inputs&) {
  StateSet live = kOutputTerms | plan.outputs;
  for (int i = Chain::kCount - 1; i >= 0; --i) {
    if (!plan.keeps(i)) continue;
    const auto index = static_cast<std::size_t>(i);
    const OperatorEntry& entry = operator_table()[index];
    if (entry.makes.meets(live)) {
      live = live | entry.uses;
    } else {
      skip(plan.operators[index], Verdict::kUnread, "no operator reads its results");
    }
  }
}

void use_environment(Plan& plan, const Inputs& inputs) {
  for_each_kept(plan, [&](PlannedOperator& op, const OperatorEntry& entry) {
    const std::string_view reason = entry.looks_around(plan.look, at_hand(inputs));
    if (reason.empty()) return;
    plan.reads_environment = true;
    op.reason = reason;
  });
}

void warn_of_input(Plan& plan, const Inputs& inputs) {
  for_each_kept(plan, [&](PlannedOperator&, const OperatorEntry& entry) {
    const std::string_view warning = entry.warning(plan.look, at_hand(inputs));
    if (!warning.empty()) plan.warnings.emplace_back(warning);
  });
}

/// An operator lit by the sky uses the radiance of the surroundings, if there is a picture of them.
void take_sky(Plan& plan, const Inputs& inputs) {
  for_each_kept(plan, [&](PlannedOperator& op, const OperatorEntry& entry) {
    if (!entry.lit_by_sky(plan.look)) return;
    plan.lit_by_sky = true;
    if (!inputs.environment) return;
    plan.reads_environment = true;
    add_reason(op, "the environment lights the water");
  });
}

/// Completes planes that the plate lacks and an operator that runs can use.
void complete_planes(Plan& plan, const Inputs& inputs) {
  for_each_kept(plan, [&](PlannedOperator& op, const OperatorEntry& entry) {
    const PlaneSet wanted = entry.wants(plan.look, at_hand(inputs));
    for (const CompleterInfo& completer : completers()) {
      const PlaneSet makes = wanted & completer.makes;
      const PlaneSet made = (makes - inputs.planes) | (makes & completer.corrects);
      if (made.empty() || !inputs.planes.covers(completer.inputs)) continue;
      plan.completed = plan.completed | made;
      const bool corrects = inputs.planes.covers(made);
      add_reason(op, std::string(completer.name) + (corrects ? " is corrected" : " is computed"));
    }
  });
}

constexpr Rule kRules[] = {
    {"take_better_input", "Buffers of the plate replace computed ones.", take_better_input},
    {"skip_absent_input", "An operator without a required input does not run.", skip_absent_input},
    {"skip_neutral", "An operator whose parameters make it the identity does not run.",
     skip_neutral},
    {"skip_unread_operator", "An operator whose results no other operator reads does not run.",
     skip_unread_operator},
    {"use_environment",
     "The environment is mirrored where no other source shows the mirrored objects.",
     use_environment},
    {"warn_of_input", "A warning names an input that an operator lacks.", warn_of_input},
    {"take_sky", "The environment lights the water.", take_sky},
    {"complete_planes", "Completers compute missing planes that an operator can use.",
     complete_planes},
    {"copy_dry", "Cells without a wet pixel are copied.", nullptr, &CellRules::copy_dry},
    {"skip_rejection", "In cells without a foreground in reach, refraction does not test for it.",
     nullptr, &CellRules::skip_rejection},
    {"skip_hidden", "In cells where fog hides the end of every path, nothing is refracted.",
     nullptr, &CellRules::skip_hidden},
    {"skip_invisible",
     "An operator that changes a cell by less than the rest of max_error does not run there.",
     nullptr, &CellRules::skip_invisible},
    {"skip_unread",
     "An operator whose results no running operator of a cell reads does not run there.", nullptr,
     &CellRules::skip_unread},
};

constexpr auto kInfos = [] {
  std::array<RuleInfo, std::size(kRules)> infos{};
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = {kRules[i].name, kRules[i].about};
  return infos;
}();

}  // namespace

std::span<const Rule> all_rules() { return kRules; }

std::span<const RuleInfo> rules() { return kInfos; }

std::string_view name_of(CellRule wanted) {
  for (const Rule& rule : kRules) {
    if (rule.cell == wanted) return rule.name;
  }
  return "";
}

/// Reports for each operator the last rule that decided about it.
void apply_rules(Plan& plan, const Inputs& inputs) {
  for (const Rule& rule : kRules) {
    if (!rule.plan) continue;
    const std::vector<PlannedOperator> before = plan.operators;
    rule.plan(plan, inputs);
    for (std::size_t j = 0; j < before.size(); ++j) {
      PlannedOperator& now = plan.operators[j];
      if (now.verdict != before[j].verdict || now.reason != before[j].reason) now.rule = rule.name;
    }
  }
}

}  // namespace limpid

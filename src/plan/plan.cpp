#include "limpid/plan/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "limpid/core/error.h"

#include "plan/leave_out.h"
#include "plan/operator_table.h"
#include "plan/rules.h"

namespace limpid {
namespace {

void leave_out(Plan& plan, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const PlannedOperator& op : plan.operators) known.emplace_back(op.name);
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      throw Error("'" + name + "' is not an operator to leave out: expected one of " + join(known) +
                  did_you_mean(name, known));
    }
    PlannedOperator& op = plan.operators[static_cast<std::size_t>(at - known.begin())];
    op.verdict = Verdict::kUnread;
    op.reason = "it is left out";
  }
}

}  // namespace

Plan make_plan(const Look& look, const Inputs& inputs, StateSet outputs, double max_error) {
  return make_plan_without({}, look, inputs, outputs, max_error);
}

Plan make_plan_without(const std::vector<std::string>& left_out, const Look& look,
                       const Inputs& inputs, StateSet outputs, double max_error) {
  look.validate();
  if (!(max_error >= 0) || std::isinf(max_error)) {
    throw Error("max_error = " + std::to_string(max_error) +
                ": expected a finite number from 0 up (white = 1)");
  }
  if (!inputs.planes.covers(kColorPlanes)) throw Error("no color: expected a dry picture");
  if (!inputs.planes.has(PlaneId::kDepth)) {
    throw Error("no depth: expected a depth that separates objects above and below the water");
  }
  Plan plan;
  plan.look = look;
  plan.primaries = inputs.primaries;
  for (const OperatorEntry& entry : operator_table()) entry.work_in(inputs.primaries, plan.look);
  plan.outputs = outputs;
  plan.max_error = max_error;
  for (const OperatorEntry& entry : operator_table())
    plan.operators.push_back({entry.name, {}, {}});
  plan.warnings = unread_settings(look);
  leave_out(plan, left_out);
  apply_rules(plan, inputs);

  plan.planes = kColorPlanes | PlaneSet{PlaneId::kColorA, PlaneId::kDepth, PlaneId::kSurfaceDepth};
  for (int i = 0; i < Chain::kCount; ++i) {
    if (!plan.keeps(i)) continue;
    const OperatorEntry& entry = operator_table()[static_cast<std::size_t>(i)];
    const Needs needs = entry.needs(plan.look);
    plan.made = plan.made | entry.makes;
    plan.planes = plan.planes | entry.reads(plan.look);
    plan.reads_wave_map |= needs.wave_map;
    plan.reads_environment |= needs.environment;
    plan.needs_sun |= needs.sun;
  }
  // No operator reads these.
  if (!plan.keeps<DepthFog>() && !plan.keeps<Caustics>()) {
    plan.made = plan.made - StateSet{StatePart::kDryBottom};
  }
  if (!outputs.has(StatePart::kMirrorSources)) {
    plan.made = plan.made - StateSet{StatePart::kMirrorSources};
  }
  for (const CompleterInfo& completer : completers()) {
    if (plan.completed.meets(completer.makes)) {
      plan.planes = plan.planes | completer.inputs | completer.optional_inputs;
    }
  }
  plan.planes = plan.planes & inputs.planes;
  if (!plan.planes.covers(kBelowPlanes)) plan.planes = plan.planes - kBelowPlanes;  // incomplete
  return plan;
}

Swell swell_of(const Plan& plan) {
  if (!plan.completed.has(PlaneId::kSurfaceDepth)) return {};
  for (const OperatorEntry& entry : operator_table()) {
    if (const Swell swell = entry.swell(plan.look); swell.raises) return swell;
  }
  return {};
}

Pass pass_of(const Plan& plan, const Scene& scene, const Frame& frame) {
  Pass pass(scene, frame, plan.look.water.ior, plan.made, swell_of(plan));
  pass.reflection_ends = plan.planes.has(PlaneId::kReflectionDepth);
  for (int i = 0; i < Chain::kCount && pass.submersible; ++i) {
    if (!plan.keeps(i) || pass.medium) continue;
    pass.medium = operator_table()[static_cast<std::size_t>(i)].medium(plan.look, pass);
  }
  return pass;
}

std::string to_text(const PlannedOperator& op) {
  constexpr std::array<const char*, 5> kWords = {
      "kept", "skipped: neutral", "skipped: input absent", "skipped: unread", "skipped: invisible"};
  const std::string word = kWords[static_cast<std::size_t>(op.verdict)];
  return op.reason.empty() ? word : word + ", " + op.reason;
}

std::string to_text(const Plan& plan) {
  std::string text;
  for (const PlannedOperator& op : plan.operators) {
    char name[32];
    std::snprintf(name, sizeof name, "%-20s", std::string(op.name).c_str());
    text += name + to_text(op) + "\n";
  }
  if (plan.max_error > 0) {
    char line[64];
    std::snprintf(line, sizeof line, "%-20s%g\n", "max_error", plan.max_error);
    text += line;
  }
  return text;
}

}  // namespace limpid

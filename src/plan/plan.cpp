#include "limpid/plan/plan.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "limpid/core/error.h"

namespace limpid {
namespace {

/// What an operator declares, evaluated for one look.
struct Declared {
  StateSet uses, makes;
  PlaneSet reads;
  Needs needs;
};

Declared declared(const Look& look, int index) {
  Declared d;
  Chain::for_each([&]<class Op, int I>() {
    if (I != index) return;
    const auto& params = look.of<Op>();
    d = {Op::kUses, Op::kMakes, Op::reads(params), Op::needs(params)};
  });
  return d;
}

bool neutral(const Look& look, int index, StateSet made) {
  bool result = false;
  Chain::for_each([&]<class Op, int I>() {
    if (I == index) result = Op::neutral(look.of<Op>(), made);
  });
  return result;
}

void drop(PlannedOperator& op, Verdict verdict, std::string reason) {
  op.verdict = verdict;
  op.reason = std::move(reason);
}

template <class Wanted>
PlannedOperator& planned(Plan& plan) {
  PlannedOperator* found = nullptr;
  Chain::for_each([&]<class Op, int I>() {
    if constexpr (std::is_same_v<Op, Wanted>) found = &plan.operators[I];
  });
  return *found;
}

// The rules. Each looks at the whole plan, changes it, and leaves its reason with the operator.

/// Normals that came with the plate are better than any that could be made up.
void take_plate_normals(Plan& plan, const Inputs& inputs, StateSet) {
  if (!inputs.planes.covers(kSurfaceNormalPlanes)) return;
  WaveNormals::Params& params = plan.look.of<WaveNormals>();
  if (params.model == WaveNormals::Model::kPlate) return;
  params.model = WaveNormals::Model::kPlate;
  planned<WaveNormals>(plan).reason = "model plate: the frame has surface normals";
}

/// A picture of the surroundings is the next best mirror.
void take_other_reflection(Plan& plan, const Inputs& inputs, StateSet) {
  FresnelReflection::Params& params = plan.look.of<FresnelReflection>();
  if (params.source != FresnelReflection::Source::kPlanar || !inputs.environment) return;
  if (inputs.planes.covers(kReflectionPlanes)) return;
  params.source = FresnelReflection::Source::kEnvironment;
  planned<FresnelReflection>(plan).reason = "source environment: the frame has no reflection";
}

void drop_absent_input(Plan& plan, const Inputs& inputs, StateSet) {
  for (int i = 0; i < Chain::kCount; ++i) {
    const Needs needs = declared(plan.look, i).needs;
    std::vector<std::string> absent;
    for (const Role& role : roles()) {
      const PlaneSet wanted = needs.planes & role.planes();
      if (!inputs.planes.covers(wanted)) absent.emplace_back(role.name);
    }
    if (needs.sun && !inputs.sun) absent.emplace_back("sun");
    if (needs.wave_map && !inputs.wave_map) absent.emplace_back("normal map");
    if (needs.environment && !inputs.environment) absent.emplace_back("environment");
    if (!absent.empty()) drop(plan.operators[i], Verdict::kAbsent, "no " + join(absent, ", no "));
  }
}

/// In chain order: what is dropped before can make what comes after neutral. Neutral means for the
/// picture: the path is measured by the way, and who makes it stays when it is to be written.
void drop_neutral(Plan& plan, const Inputs&, StateSet outputs) {
  StateSet made;
  for (int i = 0; i < Chain::kCount; ++i) {
    if (!plan.keeps(i)) continue;
    const StateSet makes = declared(plan.look, i).makes;
    const bool measured = makes.has(StatePart::kPath) && outputs.has(StatePart::kPath);
    if (neutral(plan.look, i, made) && !measured) {
      drop(plan.operators[i], Verdict::kNeutral, "its parameters change nothing here");
    } else {
      made = made | makes;
    }
  }
}

/// Backwards from what is written.
void drop_unread(Plan& plan, const Inputs&, StateSet outputs) {
  StateSet live = kOutputTerms | outputs;
  for (int i = Chain::kCount - 1; i >= 0; --i) {
    if (!plan.keeps(i)) continue;
    const Declared d = declared(plan.look, i);
    if (d.makes.meets(live)) {
      live = live | d.uses;
    } else {
      drop(plan.operators[i], Verdict::kUnread, "nothing reads what it makes");
    }
  }
}

/// What the mirror did not see comes from the surroundings, where there is a picture of them.
void fill_reflection(Plan& plan, const Inputs& inputs, StateSet) {
  using Source = FresnelReflection::Source;
  PlannedOperator& mirror = planned<FresnelReflection>(plan);
  const Source source = plan.look.of<FresnelReflection>().source;
  if (mirror.verdict != Verdict::kKept || !inputs.environment) return;
  const bool planar = source == Source::kPlanar && inputs.planes.has(PlaneId::kReflectionValid);
  if (!planar && source != Source::kAuto) return;
  plan.reads_environment = true;
  mirror.reason = inputs.planes.covers(kReflectionPlanes)
                      ? "environment where the reflection is not valid"
                      : "environment where the picture does not show what is mirrored";
}

/// A ray over a reflection without a depth ends where things infinitely far are.
void tell_depthless(Plan& plan, const Inputs& inputs, StateSet) {
  using F = FresnelReflection;
  const F::Params& params = plan.look.of<F>();
  if (planned<F>(plan).verdict != Verdict::kKept || params.source != F::Source::kPlanar) return;
  if (params.lookup != F::Lookup::kRay || inputs.planes.has(PlaneId::kReflectionDepth)) return;
  plan.warnings.push_back(
      "the reflection has no depth: all that it shows is taken to be infinitely far; expected a "
      "reflection_depth, or fresnel_reflection.source = auto");
}

/// What is lit by the sky knows its radiance best where there is a picture of the surroundings.
void take_sky(Plan& plan, const Inputs& inputs, StateSet) {
  Chain::for_each([&]<class Op, int I>() {
    if constexpr (requires { Op::lit_by_sky(plan.look.of<Op>()); }) {
      if (!plan.keeps(I) || !Op::lit_by_sky(plan.look.of<Op>())) return;
      plan.lit_by_sky = true;
      if (!inputs.environment) return;
      plan.reads_environment = true;
      std::string& reason = plan.operators[I].reason;
      reason += std::string(reason.empty() ? "" : "; ") + "the environment lights the water";
    }
  });
}

/// Planes that an operator which runs can use are made, where the plate lacks them.
void complete_planes(Plan& plan, const Inputs& inputs, StateSet) {
  const AtHand has{inputs.planes, inputs.environment, inputs.waves};
  Chain::for_each([&]<class Op, int I>() {
    if constexpr (requires { Op::wants(plan.look.of<Op>(), has); }) {
      if (!plan.keeps(I)) return;
      const PlaneSet wanted = Op::wants(plan.look.of<Op>(), has);
      for (const CompleterInfo& completer : completers()) {
        const PlaneSet makes = wanted & completer.makes;
        const PlaneSet made = (makes - inputs.planes) | (makes & completer.mends);
        if (made.empty() || !inputs.planes.covers(completer.inputs)) continue;
        plan.completed = plan.completed | made;
        std::string& reason = plan.operators[I].reason;
        reason += (reason.empty() ? "" : "; ") + std::string(completer.name) + " is made";
      }
    }
  });
}

using Rule = void (*)(Plan&, const Inputs&, StateSet outputs);

/// The first rules make the plan; those without a function look at the cells of a frame.
constexpr RuleInfo kRuleInfos[] = {
    {"take_plate_normals", "Normals of the plate replace those of maps and waves."},
    {"take_other_reflection", "The surroundings replace a reflection that is not there."},
    {"drop_absent_input", "What lacks an input that it cannot do without does not run."},
    {"drop_neutral", "What its parameters make the identity does not run."},
    {"drop_unread", "What nothing reads does not run."},
    {"fill_reflection", "The surroundings are seen where the reflection is not valid."},
    {"tell_depthless", "A warning tells of a reflection without a depth."},
    {"take_sky", "The surroundings light the water."},
    {"complete_planes", "Planes that nobody rendered are made, where an operator can use them."},
    {"copy_dry", "Cells without a wet pixel are copied."},
    {"skip_rejection", "Without foreground in reach refraction need not test for it."},
    {"skip_hidden", "Where fog hides the end of every way, nothing is refracted."},
    {"skip_invisible", "What changes a cell by less than is left of max_error does not run there."},
    {"skip_unread", "What nothing that still runs in a cell reads does not run there."},
};
constexpr Rule kRules[] = {
    take_plate_normals, take_other_reflection, drop_absent_input, drop_neutral,   drop_unread,
    fill_reflection,    tell_depthless,        take_sky,          complete_planes};

/// Says of each operator which rule spoke of it last.
void apply_rules(Plan& plan, const Inputs& inputs, StateSet outputs) {
  for (std::size_t i = 0; i < std::size(kRules); ++i) {
    const std::vector<PlannedOperator> before = plan.operators;
    kRules[i](plan, inputs, outputs);
    for (std::size_t j = 0; j < before.size(); ++j) {
      PlannedOperator& now = plan.operators[j];
      if (now.verdict != before[j].verdict || now.reason != before[j].reason) {
        now.rule = kRuleInfos[i].name;
      }
    }
  }
}

}  // namespace

std::span<const RuleInfo> rules() { return kRuleInfos; }

Plan make_plan(const Look& look, const Inputs& inputs, StateSet outputs, double max_error) {
  look.validate();
  if (!(max_error >= 0) || std::isinf(max_error)) {
    throw Error("max_error = " + std::to_string(max_error) +
                ": expected a finite number from 0 up (white = 1)");
  }
  if (!inputs.planes.covers(kColorPlanes))
    throw Error("no color: there is nothing to put water into");
  if (!inputs.planes.has(PlaneId::kDepth)) {
    throw Error("no depth: what lies above and below the water cannot be told apart");
  }
  Plan plan;
  plan.look = look;
  plan.outputs = outputs;
  plan.max_error = max_error;
  Chain::for_each([&]<class Op, int>() { plan.operators.push_back({Op::kName, {}, {}}); });
  plan.warnings = unread_settings(look);
  apply_rules(plan, inputs, outputs);

  plan.planes = kColorPlanes | PlaneSet{PlaneId::kColorA, PlaneId::kDepth, PlaneId::kSurfaceDepth};
  for (int i = 0; i < Chain::kCount; ++i) {
    if (!plan.keeps(i)) continue;
    plan.made = plan.made | declared(plan.look, i).makes;
    plan.planes = plan.planes | declared(plan.look, i).reads;
    plan.reads_wave_map |= declared(plan.look, i).needs.wave_map;
    plan.reads_environment |= declared(plan.look, i).needs.environment;
    plan.needs_sun |= declared(plan.look, i).needs.sun;
  }
  // No operator reads it.
  if (!outputs.has(StatePart::kMirrorSources)) {
    plan.made = plan.made - StateSet{StatePart::kMirrorSources};
  }
  for (const CompleterInfo& completer : completers()) {
    if (plan.completed.meets(completer.makes)) {
      plan.planes = plan.planes | completer.inputs | completer.helped;
    }
  }
  plan.planes = plan.planes & inputs.planes;
  if (!plan.planes.covers(kBelowPlanes)) plan.planes = plan.planes - kBelowPlanes;  // half a layer
  return plan;
}

Swell Plan::swell() const {
  if (!completed.has(PlaneId::kSurfaceDepth)) return {};
  const WaveNormals::Params& params = look.of<WaveNormals>();
  return {true, params.waves, params.strength};
}

std::string to_text(const PlannedOperator& op) {
  constexpr std::array<const char*, 5> kWords = {
      "kept", "dropped: neutral", "dropped: input absent", "dropped: unread", "dropped: invisible"};
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

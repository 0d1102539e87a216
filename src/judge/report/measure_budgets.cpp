#include <algorithm>

#include "limpid/plan/survey.h"
#include "limpid/run/fused.h"

#include "judge/report/measure.h"
#include "judge/report/numbers.h"
#include "judge/report/rounds.h"
#include "op/pass.h"

namespace limpid {
namespace {

constexpr double kAllowed[] = {0, 0.0005, 0.002, 0.01, 0.05};

struct Variant {
  std::string name;
  Look look;
};

/// The standard look; and a look with lookups so short and fog so dense that the survey can find
/// cells with a hidden bottom.
std::vector<Variant> waters_of(const Measuring& m) {
  const auto at = std::find_if(m.looks.begin(), m.looks.end(),
                               [](const Look& look) { return look.name == "realistic"; });
  std::vector<Variant> waters{{m.physical.name, m.physical}};
  if (at == m.looks.end()) return waters;
  Look murky = *at;
  murky.set(DepthFog::kName, "density", 4.0);
  murky.set(DepthFog::kName, "alpha", 1.0);
  waters.push_back({"realistic, murky", murky});
  return waters;
}

/// A run with a budget, and its row.
struct Budget {
  Plan plan;
  Frame frame;
  BudgetRow row;
};

/// The planner's promise for this frame.
void survey(const Budget& budget, const Subject& subject, const Measuring& m, BudgetRow& row) {
  const Pass pass(subject.scene(), budget.frame, budget.plan.look.water.ior, budget.plan.made);
  Survey survey;
  survey.make(budget.plan, budget.frame, pass, m.many, m.simd);
  const Survey::Summary& all = survey.summary();
  const auto share = [&](const CellCount& cells) {
    return static_cast<double>(cells.pixels) / static_cast<double>(all.all.pixels);
  };
  row.bound = all.bound;
  row.dry_share = share(all.dry);
  row.opaque_share = share(all.opaque);
  row.full_share = share(all.full);
}

}  // namespace

void measure_budgets(const Measuring& m, Subject& subject) {
  std::vector<Budget> budgets;
  for (const Variant& water : waters_of(m)) {
    for (const double allowed : kAllowed) {
      const Plan plan = subject.plan(water.look, allowed);
      Budget budget{plan, subject.frame_for(plan), {}};
      budget.row.subject = subject.facts().name;
      budget.row.water = water.name;
      budget.row.max_error = allowed;
      survey(budget, subject, m, budget.row);
      budgets.push_back(std::move(budget));
    }
  }
  Picture exact(subject.window()), picture(subject.window());
  std::vector<Timed> timed;
  for (Budget& budget : budgets) {
    timed.push_back({[&] {
      run_fused(budget.plan, budget.frame, subject.scene(), picture.target, m.one,
                {.simd = m.simd});
    }});
    timed.back().run();
    if (budget.row.max_error == 0) {
      run_fused(budget.plan, budget.frame, subject.scene(), exact.target, m.many, {.simd = m.simd});
    }
    budget.row.error = error_of(picture, exact, true);
  }
  time_rounds(timed, m.options.rounds);
  for (std::size_t i = 0; i < budgets.size(); ++i) {
    BudgetRow& row = budgets[i].row;
    row.ns_per_pixel = 1e9 * timed[i].best_seconds / subject.pixels();
    m.say(row.subject + ", " + row.water + ", allowed " + plain_number(row.max_error) + ": " +
          costs_text(row.ns_per_pixel, row.error));
    m.report.budgets.push_back(row);
  }
}

}  // namespace limpid

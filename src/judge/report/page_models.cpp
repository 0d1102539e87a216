// Models: ways to refract beside the truth, choices of physical, error budgets.
#include <algorithm>
#include <cmath>

#include "limpid/core/error.h"

#include "judge/report/html_parts.h"
#include "judge/report/markup.h"
#include "judge/report/page_plots.h"
#include "judge/report/page_sections.h"
#include "judge/report/pareto.h"

namespace limpid {
namespace {

constexpr const char* kFrontCaption =
    "Filled, on the stepped line: the Pareto front. Hollow: beaten. Both axes are logarithmic.";

template <class Row>
std::vector<bool> on_front(const std::vector<Row>& rows, double (*error)(const Row&)) {
  std::vector<Costs> costs;
  for (const Row& row : rows) {
    costs.push_back({row.ns_per_pixel > 0 ? row.ns_per_pixel : HUGE_VAL, error(row)});
  }
  std::vector<bool> on(rows.size());
  for (std::size_t i : pareto_front(costs)) on[i] = true;
  return on;
}

// ---- refraction beside the truth

using TruthCost = double (*)(const TruthRow&);

double wet_error(const TruthRow& row) { return row.wet; }
double in_frame_error(const TruthRow& row) { return row.in_frame; }

/// "snell march, shorten" is the point "march" of the series "rejection shorten".
Scatter truth_plot(const Report& report, TruthCost error, const std::string& over) {
  Scatter plot;
  plot.title = "Ways to refract beside a path-traced truth, " + over;
  plot.time_axis = kTimeAxis;
  plot.error_axis = "mean error over mean truth, " + over;
  for (const TruthRow& row : report.truth) {
    if (!(row.ns_per_pixel > 0)) continue;
    const std::size_t comma = row.choice.find(", ");
    const bool snell = comma != std::string::npos;
    std::string label = row.choice.substr(0, comma);
    if (label.starts_with("snell ")) label = label.substr(6);
    const std::string series = snell ? "rejection " + row.choice.substr(comma + 2) : row.choice;
    add_point(plot, {row.ns_per_pixel, error(row), index_in(plot.series, series), label,
                     about(row.choice, row.ns_per_pixel, error(row))});
  }
  return plot;
}

std::string truth_table(const Report& report) {
  const std::vector<bool> wet = on_front(report.truth, wet_error);
  const std::vector<bool> in_frame = on_front(report.truth, in_frame_error);
  HtmlTable table(
      "Mean |picture - truth| over mean truth, values above 4 counted as 4. Set off: on the Pareto "
      "front of time and error over all wet pixels.",
      {{"refraction, rejection", "", false},
       {"time", "ns/pixel"},
       {"all wet", "error"},
       {"in frame", "error"},
       {"Pareto front", "", false}});
  for (std::size_t i = 0; i < report.truth.size(); ++i) {
    const TruthRow& row = report.truth[i];
    std::vector<std::string> fronts;
    if (wet[i]) fronts.emplace_back("all wet");
    if (in_frame[i]) fronts.emplace_back("in frame");
    const bool runs = row.ns_per_pixel > 0;
    table.add({row.choice, runs ? Cell(row.ns_per_pixel) : Cell("-"), percent(row.wet, 2),
               percent(row.in_frame, 2), fronts.empty() ? "-" : join(fronts)},
              wet[i]);
  }
  return table.html();
}

// ---- choices of the look physical

double mean_error(const ChoiceRow& row) { return row.error.mean; }

std::string name_of(const ChoiceRow& row) {
  return row.parameter.empty() ? "physical as it is" : row.parameter + " = " + row.value;
}

Scatter choice_plot(const Report& report) {
  Scatter plot;
  plot.title = "The look physical with one choice changed";
  plot.time_axis = kTimeAxis;
  plot.error_axis = "mean difference from physical";
  const std::vector<bool> front = on_front(report.choices, mean_error);
  const double own = report.choices.front().ns_per_pixel;
  for (std::size_t i = 0; i < report.choices.size(); ++i) {
    const ChoiceRow& row = report.choices[i];
    const std::size_t dot = row.parameter.find('.');
    const std::string series =
        row.parameter.empty() ? "physical as it is" : row.parameter.substr(0, dot);
    const std::string label =
        row.parameter.empty() ? series : row.parameter.substr(dot + 1) + " " + row.value;
    // What saves next to nothing is told by the table.
    const bool named = front[i] || i == 0 || row.ns_per_pixel < 0.9 * own;
    add_point(plot, {row.ns_per_pixel, row.error.mean, index_in(plot.series, series),
                     named ? label : "", about(name_of(row), row.ns_per_pixel, row.error.mean)});
  }
  return plot;
}

std::string choice_table(const Report& report) {
  const std::vector<bool> front = on_front(report.choices, mean_error);
  const double own = report.choices.front().ns_per_pixel;
  HtmlTable table("Set off: on the Pareto front. Values above 4 count as 4.",
                  {{"choice", "", false},
                   {"time", "ns/pixel"},
                   {"of physical", "time"},
                   {"mean", "difference"},
                   {"99 %", "difference"},
                   {"max", "difference"}});
  for (std::size_t i = 0; i < report.choices.size(); ++i) {
    const ChoiceRow& row = report.choices[i];
    table.add({name_of(row), Cell(row.ns_per_pixel), percent(row.ns_per_pixel / own),
               Cell(row.error.mean), Cell(row.error.p99), Cell(row.error.max)},
              front[i]);
  }
  return table.html();
}

// ---- error budgets

/// Two of the water that BudgetRow names, one plot each.
std::vector<std::string> waters_of(const Report& report) {
  std::vector<std::string> waters;
  for (const BudgetRow& row : report.budgets) index_in(waters, row.water);
  return waters;
}

Scatter budget_plot(const Report& report, const std::string& water) {
  Scatter plot;
  plot.title = "Allowed errors, " + water;
  plot.time_axis = kTimeAxis;
  plot.error_axis = "largest error measured";
  plot.front = false;
  plot.connected = true;
  for (const BudgetRow& row : report.budgets) {
    if (row.water != water) continue;
    const std::size_t series = index_in(plot.series, row.subject);
    const std::string allowed = plain_number(row.max_error);
    add_point(plot, {row.ns_per_pixel, row.error.max, series, allowed,
                     about(row.subject + ", allowed " + allowed, row.ns_per_pixel, row.error.max)});
  }
  return plot;
}

bool any_error(const Report& report, const std::string& water) {
  return std::any_of(report.budgets.begin(), report.budgets.end(),
                     [&](const BudgetRow& row) { return row.water == water && row.error.max > 0; });
}

double time_without_budget(const Report& report, const BudgetRow& row) {
  for (const BudgetRow& exact : report.budgets) {
    if (exact.subject == row.subject && exact.water == row.water && exact.max_error == 0) {
      return exact.ns_per_pixel;
    }
  }
  return std::nan("");
}

std::string budget_table(const Report& report) {
  HtmlTable table(
      "Pixels: in cells of the picture that have no water; whose bottom cannot be seen; that leave "
      "out nothing.",
      {{"subject", "", false},
       {"water", "", false},
       {"allowed", "error"},
       {"time", "ns/pixel"},
       {"of exact", "time"},
       {"mean", "error"},
       {"max", "error"},
       {"bound", "error"},
       {"dry", "of pixels"},
       {"opaque", "of pixels"},
       {"full", "of pixels"}});
  for (const BudgetRow& row : report.budgets) {
    if (row.max_error == 0) table.begin_group();
    table.add({row.subject, row.water, Cell(row.max_error, plain_number(row.max_error)),
               Cell(row.ns_per_pixel), percent(row.ns_per_pixel / time_without_budget(report, row)),
               Cell(row.error.mean), Cell(row.error.max), Cell(row.bound), percent(row.dry_share),
               percent(row.opaque_share), percent(row.full_share)});
  }
  return table.html();
}

}  // namespace

std::string truth_section(const Report& report) {
  if (report.truth.empty()) return "";
  return section(
      "truth", "Ways to refract, beside the truth",
      paragraph("The plate " + code("lagoon") +
                " was rendered twice by a path tracer: dry, and with calm water. The water is put "
                "into the dry one in several ways, all else being as in the truth. A refracted ray "
                "may end beyond the edge of the dry picture, where any way must guess: <i>in "
                "frame</i> are the " +
                percent(report.truth_in_frame_share).text +
                " of the wet pixels whose bottom the dry picture shows.") +
          gallery(report.truth_figures) + "<h3>Where they differ from the truth</h3>\n" +
          gallery(report.truth_errors) + heat_legend(3) +
          drawn(truth_plot(report, wet_error, "all wet pixels"), kFrontCaption) +
          drawn(truth_plot(report, in_frame_error, "in frame"), kFrontCaption) +
          truth_table(report));
}

std::string choices_section(const Report& report) {
  if (report.choices.empty()) return "";
  return section("choices", "What each choice of physical costs and is worth",
                 paragraph("The look " + code("physical") + " on " + code(report.choices_subject) +
                           " with one parameter changed, the others being its own or their "
                           "defaults; judged by the look as it is. What stands to the left of it "
                           "is cheaper.") +
                     drawn(choice_plot(report), std::string(kFrontCaption) + kBandCaption) +
                     choice_table(report));
}

std::string budgets_section(const Report& report) {
  if (report.budgets.empty()) return "";
  std::string plots;
  for (const std::string& water : waters_of(report)) {
    if (!any_error(report, water)) {
      plots += paragraph(escaped(water) + ": no error that was allowed changed a pixel.");
      continue;
    }
    plots += drawn(
        budget_plot(report, water),
        escaped(water) + ": each line is a subject, each marker an allowed error." + kBandCaption);
  }
  return section(
      "budgets", "Error budgets",
      paragraph("The planner may leave out, cell by cell of the picture, what changes no "
                "channel of any pixel by more than an allowed error (" +
                code("max_error") +
                ", white = 1). The bound is what it promises, the error what is "
                "measured beside the same picture with none allowed. What "
                "changes not a bit (dry cells, a bottom that cannot be seen) is left out in any "
                "case.") +
          plots + budget_table(report));
}

}  // namespace limpid

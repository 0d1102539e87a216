// The sections with measured rows: tables and plots.
#include <algorithm>
#include <cmath>

#include "limpid/core/error.h"

#include "report/html_parts.h"
#include "report/markup.h"
#include "report/page_sections.h"
#include "report/pareto.h"
#include "report/scatter.h"

namespace limpid {
namespace {

constexpr const char* kTimeAxis = "time, ns/pixel, one thread";
constexpr const char* kFrontCaption =
    "Filled, on the stepped line: the Pareto front. Hollow: beaten. Both axes are logarithmic.";
constexpr const char* kBandCaption = " What has no error at all stands in the band 0.";

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

std::string about(const std::string& what, double ns, double error) {
  return what + ": " + short_number(ns) + " ns/pixel, error " + short_number(error);
}

std::size_t index_in(std::vector<std::string>& list, const std::string& word) {
  const auto at = std::find(list.begin(), list.end(), word);
  if (at == list.end()) list.push_back(word);
  return static_cast<std::size_t>(std::find(list.begin(), list.end(), word) - list.begin());
}

/// An infinite error (a NaN in one picture) is told by the table alone.
void add_point(Scatter& scatter, ScatterPoint point) {
  if (std::isfinite(point.error)) scatter.points.push_back(std::move(point));
}

std::string drawn(const Scatter& scatter, const std::string& caption) {
  return scatter.points.empty() ? "" : plot_figure(to_svg(scatter), caption);
}

// ---- looks by runner

Scatter runner_plot(const Report& report) {
  Scatter plot;
  plot.title = "Looks by instruction set on " + report.subjects.front().name;
  plot.time_axis = kTimeAxis;
  plot.error_axis = "mean error beside the reference";
  plot.front = false;
  for (const RunnerRow& row : report.runners) {
    const bool shown = row.subject == report.subjects.front().name && row.threads == 1;
    if (!shown || row.runner == "reference") continue;
    const std::size_t series = index_in(plot.series, row.simd);
    add_point(plot, {row.ns_per_pixel, row.error.mean, series, row.look,
                     about(row.look + ", " + row.simd, row.ns_per_pixel, row.error.mean)});
  }
  return plot;
}

/// A row of the table: a look on a subject, all its ways to run side by side.
struct RunnerLine {
  const Report& report;
  const std::string& subject;
  const std::string& look;

  std::vector<Cell> cells() const {
    std::vector<Cell> cells{subject, look, time("reference", "", 1)};
    for (const std::string& simd : report.machine.simd) cells.push_back(time("fused", simd, 1));
    if (report.threads > 1) cells.push_back(time("fused", report.simd, report.threads));
    PixelError worst;
    for (const RunnerRow& row : report.runners) {
      if (row.subject != subject || row.look != look) continue;
      worst.mean = std::max(worst.mean, row.error.mean);
      worst.p99_99 = std::max(worst.p99_99, row.error.p99_99);
      worst.max = std::max(worst.max, row.error.max);
    }
    for (double e : {worst.mean, worst.p99_99, worst.max}) cells.emplace_back(e);
    return cells;
  }

 private:
  Cell time(std::string_view runner, std::string_view simd, int threads) const {
    for (const RunnerRow& row : report.runners) {
      if (row.subject == subject && row.look == look && row.runner == runner && row.simd == simd &&
          row.threads == threads) {
        return Cell(row.ns_per_pixel);
      }
    }
    return Cell("-");
  }
};

std::string runner_table(const Report& report) {
  std::vector<Column> columns{
      {"subject", "", false}, {"look", "", false}, {"reference", "ns/pixel"}};
  for (const std::string& simd : report.machine.simd) columns.push_back({simd, "ns/pixel"});
  if (report.threads > 1) {
    columns.push_back(
        {report.simd + ", " + std::to_string(report.threads) + " threads", "ns/pixel"});
  }
  columns.insert(columns.end(), {{"mean", "error"}, {"99.99 %", "error"}, {"max", "error"}});
  HtmlTable table(
      "One thread but where it says otherwise. Errors: the worst of the fused runs, beside the "
      "reference.",
      columns);
  for (const ReportSubject& subject : report.subjects) {
    table.begin_group();
    for (const std::string& look : report.looks) {
      table.add(RunnerLine{report, subject.name, look}.cells());
    }
  }
  return table.html();
}

// ---- looks beside physical

Scatter look_plot(const Report& report) {
  Scatter plot;
  plot.title = "Looks beside physical";
  plot.time_axis = kTimeAxis;
  plot.error_axis = "mean difference from physical";
  plot.front = false;
  for (const LookRow& row : report.look_rows) {
    const std::size_t series = index_in(plot.series, row.look);
    add_point(plot,
              {row.ns_per_pixel, row.error.mean, series, row.look == "fast" ? row.subject : "",
               about(row.look + " on " + row.subject, row.ns_per_pixel, row.error.mean)});
  }
  return plot;
}

double time_of_physical(const Report& report, const std::string& subject) {
  for (const LookRow& row : report.look_rows) {
    if (row.subject == subject && row.look == "physical") return row.ns_per_pixel;
  }
  return std::nan("");
}

std::string look_tables(const Report& report) {
  HtmlTable table("Values above 4 count as 4.", {{"subject", "", false},
                                                 {"look", "", false},
                                                 {"time", "ns/pixel"},
                                                 {"of physical", "time"},
                                                 {"mean", "difference"},
                                                 {"99 %", "difference"},
                                                 {"99.99 %", "difference"},
                                                 {"max", "difference"}});
  std::string what;
  for (const LookRow& row : report.look_rows) {
    if (row.look == report.looks.front()) table.begin_group();
    const double share = row.ns_per_pixel / time_of_physical(report, row.subject);
    table.add({row.subject, row.look, Cell(row.ns_per_pixel), percent(share), Cell(row.error.mean),
               Cell(row.error.p99), Cell(row.error.p99_99), Cell(row.error.max)});
    if (row.subject != report.subjects.front().name || row.differs.empty()) continue;
    what += "<dt>" + code(row.look) + "</dt><dd>" + escaped(join(row.differs, "; ")) + "</dd>\n";
  }
  return "<h3>What they leave out or do by another model, on " +
         escaped(report.subjects.front().name) + "</h3>\n<dl class=\"facts\">\n" + what +
         "</dl>\n" + table.html();
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

std::string runners_section(const Report& report) {
  if (report.runners.empty()) return "";
  return section(
      "runners", "Looks by runner",
      paragraph("The reference computes in double, one operator after the other, "
                "without any approximation, and judges the fused runner, which computes "
                "in single precision and in one pass, compiled once for each "
                "instruction set.") +
          drawn(runner_plot(report), "The fused runner on " + code(report.subjects.front().name) +
                                         ": a marker a look and instruction set.") +
          runner_table(report));
}

std::string looks_section(const Report& report) {
  if (report.look_rows.empty()) return "";
  return section(
      "looks", "Looks beside physical",
      paragraph(
          "Each look is a water of its own, so a difference is no fault by itself. The look " +
          code("fast") + " means to be " + code("physical") +
          " at a lower price: for it the difference is the error.") +
          gallery(report.look_figures) + "<h3>Where they differ from physical</h3>\n" +
          gallery(report.look_errors) + heat_legend(3) +
          drawn(look_plot(report),
                "A marker a look and subject; the subjects are named beside " + code("fast") +
                    ", and where one points. Both axes are logarithmic; " + code("physical") +
                    " itself, which differs by nothing, stands in the band 0.") +
          look_tables(report));
}

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
                "measured beside the same picture with none allowed. Murky water hides "
                "its bottom, so that more can be left out.") +
          plots + budget_table(report));
}

}  // namespace limpid

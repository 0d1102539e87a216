// Looks: by runner, and beside the look physical.
#include <algorithm>
#include <cmath>

#include "limpid/core/error.h"

#include "judge/report/html_parts.h"
#include "judge/report/markup.h"
#include "judge/report/page_plots.h"
#include "judge/report/page_sections.h"

namespace limpid {
namespace {

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

}  // namespace limpid

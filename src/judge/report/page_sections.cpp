#include "judge/report/page_sections.h"

#include <algorithm>
#include <cmath>

#include "limpid/core/error.h"

#include "judge/report/html_parts.h"
#include "judge/report/markup.h"

namespace limpid {
namespace {

std::string text_of(Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

std::string item(const std::string& html) { return "<li>" + html + "</li>\n"; }

std::string fact(std::string_view name, std::string_view value) {
  return "<dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
}

/// The row of a look on the first subject, or null.
template <class Row>
const Row* row_of(const Report& report, const std::vector<Row>& rows, std::string_view look) {
  for (const Row& row : rows) {
    if (row.subject == report.subjects.front().name && row.look == look) return &row;
  }
  return nullptr;
}

std::string physical_item(const Report& report, const LookRow& physical) {
  const ReportSubject& subject = report.subjects.front();
  std::string html = "The look " + code("physical") + " takes <b>" +
                     short_number(physical.ns_per_pixel) + " ns a pixel</b> on the " +
                     subject.kind + " " + code(subject.name) + " (" + text_of(subject.size) + ", " +
                     percent(subject.wet_share).text + " wet, one thread, " + report.simd + ")";
  for (const RunnerRow& row : report.runners) {
    if (row.subject != subject.name || row.look != physical.look || row.threads == 1) continue;
    html += ", " + short_number(row.ns_per_pixel) + " ns on " + std::to_string(row.threads) +
            " threads: " + short_number(row.ns_per_pixel * 1920 * 1080 / 1e6) +
            " ms for as many pixels as 1920x1080 has";
  }
  return item(html + ".");
}

std::string fast_item(const LookRow& physical, const LookRow& fast) {
  return item("The look " + code("fast") + " takes <b>" +
              percent(fast.ns_per_pixel / physical.ns_per_pixel).text +
              "</b> of that; its picture differs from that of " + code("physical") + " by " +
              short_number(fast.error.mean) + " in the mean (white = 1).");
}

std::string fused_item(const Report& report) {
  double least = HUGE_VAL, most = 0, mean = 0;
  for (const RunnerRow& row : report.runners) {
    if (row.runner == "reference" || row.threads != 1 || row.simd != report.simd) continue;
    mean = std::max(mean, row.error.mean);
    for (const RunnerRow& judge : report.runners) {
      if (judge.runner != "reference" || judge.subject != row.subject || judge.look != row.look) {
        continue;
      }
      const double times = judge.ns_per_pixel / row.ns_per_pixel;
      least = std::min(least, times);
      most = std::max(most, times);
    }
  }
  if (most == 0) return "";
  return item("The fused runner is <b>" + short_number(least) + " to " + short_number(most) +
              " times</b> as fast as the reference in double, both on one thread; its mean error "
              "is at most " +
              short_number(mean) + " over all looks and subjects.");
}

std::string truth_item(const Report& report) {
  const auto named = [&](std::string_view name) {
    return std::find_if(report.truth.begin(), report.truth.end(),
                        [&](const TruthRow& row) { return row.choice == name; });
  };
  const auto none = named("no refraction"), march = named("snell march, shorten");
  if (none == report.truth.end() || march == report.truth.end()) return "";
  return item(
      "Beside a path-traced picture of the same water, following the refracted rays takes "
      "the error from <b>" +
      percent(none->wet, 1).text + "</b> to <b>" + percent(march->wet, 1).text + "</b>, at " +
      short_number(march->ns_per_pixel / none->ns_per_pixel) + " times the time.");
}

}  // namespace

std::string summary(const Report& report) {
  const LookRow* physical = row_of(report, report.look_rows, "physical");
  const LookRow* fast = row_of(report, report.look_rows, "fast");
  std::string html = "<ul class=\"short\">\n";
  if (physical) html += physical_item(report, *physical);
  if (physical && fast) html += fast_item(*physical, *fast);
  return html + fused_item(report) + truth_item(report) + "</ul>\n";
}

std::string facts_section(const Report& report) {
  const ReportMachine& m = report.machine;
  const ReportBuild& b = report.build;
  return section(
      "machine", "Machine and versions",
      "<dl class=\"facts\">\n" + fact("processor", m.processor) +
          fact("cores", std::to_string(m.cores)) + fact("instruction sets", join(m.simd)) +
          fact("system", m.system + ", kernel " + m.kernel) + fact("limpid", b.version) +
          fact("compiler", b.compiler + ", build type " + b.type) + fact("libraries", b.libraries) +
          fact("rounds", std::to_string(report.rounds)) +
          fact("threads", report.threads == 1
                              ? "1"
                              : "1, or " + std::to_string(report.threads) + " where it says so") +
          "</dl>\n");
}

std::string subjects_section(const Report& report) {
  HtmlTable table(
      "What water is put into. Wet: share of the pixels that the look physical changes.",
      {{"name", "", false},
       {"kind", "", false},
       {"width", "pixels"},
       {"height", "pixels"},
       {"wet", "of all pixels"}});
  for (const ReportSubject& s : report.subjects) {
    table.add({s.name, s.kind, Cell(double(s.size.width), std::to_string(s.size.width)),
               Cell(double(s.size.height), std::to_string(s.size.height)), percent(s.wet_share)});
  }
  return section("subjects", "Plates and scenes",
                 paragraph("A plate was rendered elsewhere; a scene is rendered by limpid itself, "
                           "which is no part of the times below. The pictures show the look " +
                           code("physical") + ".") +
                     gallery(report.subject_figures) + table.html());
}

std::string method_section(const Report& report) {
  return section(
      "method", "How it was measured",
      paragraph(
          "<b>Time</b> is that of the water alone, all planes being in memory: neither "
          "reading nor rendering nor writing. It is divided by all pixels of the picture, dry "
          "ones too. On one thread it is the time of that thread on its processor, which other "
          "programs disturb little; on several the wall's. Timed runs go over all rows of a "
          "subject in turn, " +
          std::to_string(report.rounds) +
          " rounds, after one that does not count; the best of a row is told. The reference "
          "has two rounds at most.") +
          paragraph(
              "<b>Error</b> is |picture - judge| of red, green and blue, scene-linear, white = 1, "
              "over all pixels of the picture: mean, 99th and 99.99th percentile, maximum. But for "
              "runners beside the reference, values above 4 count as 4, for glints of the sun "
              "reach thousands. "
              "Beside the truth it is mean |picture - truth| over mean truth, of wet pixels "
              "only.") +
          paragraph("<b>Pareto front</b>: the choices that no other one beats, being as good in "
                    "both time and error and better in one. In plots they are filled and on the "
                    "stepped line, in tables set off.") +
          paragraph("The same rows are in " + code("report.json") + ", beside this page."));
}

}  // namespace limpid

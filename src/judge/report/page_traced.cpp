// Looks, and choices of the look physical, beside ray-traced truth.
#include "judge/report/html_parts.h"
#include "judge/report/markup.h"
#include "judge/report/page_plots.h"
#include "judge/report/page_sections.h"

namespace limpid {
namespace {

std::vector<Column> columns_of(const char* first, const char* second) {
  return {{first, "", false},
          {second, "", false},
          {"time", "ns/pixel"},
          {"mean", "error"},
          {"RMSE", ""},
          {"relMSE", ""},
          {"SSIM", ""},
          {"FLIP", ""},
          {"HDR-FLIP", ""},
          {"flicker", "mean"},
          {"off", "median px"},
          {"off", "95 % px"},
          {"rejected", "wrongly"},
          {"accepted", "wrongly"}};
}

void add_row(HtmlTable& table, const std::string& first, const std::string& second,
             const ModelRow& row) {
  table.add({first, second, Cell(row.ns_per_pixel), Cell(row.error.mean), Cell(row.rmse),
             Cell(row.rel_mse), Cell(row.ssim), Cell(row.flip), Cell(row.hdr_flip),
             Cell(row.flicker), Cell(row.offset_median), Cell(row.offset_p95),
             percent(row.wrongly_rejected, 1), percent(row.wrongly_accepted, 1)});
}

std::string look_table(const Report& report) {
  HtmlTable table("Every look beside the traced water of physical.", columns_of("scene", "look"));
  for (const ModelRow& row : report.models) {
    if (!row.parameter.empty()) continue;
    if (row.look == report.looks.front()) table.begin_group();
    add_row(table, row.subject, row.look, row);
  }
  return table.html();
}

std::string choice_table(const Report& report, std::string& subject) {
  HtmlTable table("The look physical with one choice changed, beside the same truth.",
                  columns_of("choice", "value"));
  for (const ModelRow& row : report.models) {
    if (!row.parameter.empty()) subject = row.subject;
  }
  for (const ModelRow& row : report.models) {
    if (row.subject != subject) continue;
    if (row.look != "physical") continue;
    if (row.parameter.empty()) {
      add_row(table, "physical as it is", "", row);
    } else {
      add_row(table, row.parameter, row.value, row);
    }
  }
  return subject.empty() ? "" : table.html();
}

Scatter look_plot(const Report& report) {
  Scatter plot;
  plot.title = "Looks beside traced light";
  plot.time_axis = kTimeAxis;
  plot.error_axis = "FLIP, mean";
  plot.front = false;
  for (const ModelRow& row : report.models) {
    if (!row.parameter.empty()) continue;
    add_point(plot, {row.ns_per_pixel, row.flip, index_in(plot.series, row.look),
                     row.look == "physical" ? row.subject : "",
                     about(row.look + " on " + row.subject, row.ns_per_pixel, row.flip)});
  }
  return plot;
}

}  // namespace

std::string traced_section(const Report& report) {
  if (report.models.empty()) return "";
  std::string subject;
  const std::string choices = choice_table(report, subject);
  std::string html =
      paragraph(
          "The light that would really arrive is traced, ray by ray, through each scene "
          "with the water of " +
          code("physical") +
          ": what is mirrored and what lies in the water is met where it is, seen by the "
          "camera or not. So this is the error of looking things up in pictures, and, for "
          "looks other than " +
          code("physical") + " and " + code("fast") +
          ", of being another water. One sample a pixel, as in the chain.") +
      gallery(report.model_figures) + "<h3>Where physical differs from that</h3>\n" +
      gallery(report.model_errors) + heat_legend(3) +
      drawn(look_plot(report), "A marker a look and scene; the scenes are named beside " +
                                   code("physical") + ". Both axes are logarithmic.") +
      look_table(report);
  if (!choices.empty()) {
    html += "<h3>One choice of physical changed, on " + escaped(subject) + "</h3>\n" + choices;
  }
  return section(
      "traced", "Models beside traced light",
      html + paragraph("<b>Flicker</b>: |change of the picture - change of the truth| to the "
                       "next of 24 frames a second. <b>Off</b>: between where a color "
                       "was looked up and where its refracted ray ends in the picture, where "
                       "that can be seen and the chain did not fall back. <b>Wrongly "
                       "rejected</b>: it could be seen, and the chain fell back; <b>wrongly "
                       "accepted</b>: it could not, and the chain took what it found; shares "
                       "of the lookups of wet pixels."));
}

}  // namespace limpid

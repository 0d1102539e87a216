// Looks by what one brings.
#include <algorithm>

#include "judge/report/html_parts.h"
#include "judge/report/markup.h"
#include "judge/report/page_plots.h"
#include "judge/report/page_sections.h"

namespace limpid {
namespace {

/// Whether it is the first row of its subject and look.
bool begins(const Report& report, std::size_t row) {
  if (row == 0) return true;
  const BroughtRow &above = report.brought[row - 1], &here = report.brought[row];
  return above.subject != here.subject || above.look != here.look;
}

std::string row_table(const Report& report) {
  HtmlTable table(
      "Each row has the buffers of those above it, too. Error: mean |picture - truth| over mean "
      "truth, of wet pixels, values above 4 counted as 4. FLIP: mean of the wet pixels.",
      {{"subject", "", false},
       {"look", "", false},
       {"brought", "", false, true},
       {"time", "ns/pixel"},
       {"all wet", "error"},
       {"near", "error"},
       {"far", "error"},
       {"FLIP", ""}});
  for (std::size_t i = 0; i < report.brought.size(); ++i) {
    const BroughtRow& row = report.brought[i];
    const bool first = begins(report, i);
    if (first) table.begin_group();
    table.add({row.subject, row.look, (first ? "" : "and ") + row.brought, Cell(row.ns_per_pixel),
               Cell(row.wet), Cell(row.near), Cell(row.far), Cell(row.flip)});
  }
  return table.html();
}

std::string subject_table(const Report& report) {
  HtmlTable table("Near are the wet pixels whose footprint is shorter than the waves are long.",
                  {{"subject", "", false},
                   {"waves", "units long"},
                   {"wet", "of all pixels"},
                   {"near", "of wet pixels"}});
  for (const BroughtSubject& s : report.brought_subjects) {
    table.add({s.subject, Cell(s.wave_length), percent(s.wet_share), percent(s.near_share)});
  }
  return table.html();
}

/// Of physical: how the error falls, and at what time, from buffer to buffer.
Scatter plot_of(const Report& report) {
  Scatter plot;
  plot.title = "physical by what is brought";
  plot.time_axis = kTimeAxis;
  plot.error_axis = "mean error over mean truth, all wet pixels";
  plot.front = false;
  plot.connected = true;
  for (std::size_t i = 0; i < report.brought.size(); ++i) {
    const BroughtRow& row = report.brought[i];
    if (row.look != "physical") continue;
    add_point(plot, {row.ns_per_pixel, row.wet, index_in(plot.series, row.subject),
                     begins(report, i) ? row.subject : "",
                     about(row.subject + ", " + row.brought, row.ns_per_pixel, row.wet)});
  }
  return plot;
}

}  // namespace

std::string brought_section(const Report& report) {
  if (report.brought.empty()) return "";
  const std::string samples = std::to_string(kBroughtSamples * kBroughtSamples);
  return section(
      "brought", "What each buffer buys",
      paragraph("Plates have a color and a depth; all else is made from these where it can be. "
                "Here a plate gets one buffer more from row to row. It is judged by the picture "
                "with the water and its waves: the plate " +
                code("lagoon") + " path-traced, the scenes traced with " + samples +
                " samples a pixel and the water of " + code("physical") +
                ". The waves are those of that picture: the scene's sines, raised, until the "
                "surface itself is brought; where it has none, those of the look's map. No "
                "surroundings are brought, and the look computes one sample a pixel.") +
          gallery(report.brought_figures) +
          drawn(plot_of(report),
                "A line a subject, from color and depth alone, where its name "
                "stands, to all buffers. Both axes are logarithmic.") +
          row_table(report) + subject_table(report) +
          paragraph("A <b>footprint</b> is what a pixel covers of the calm water; its longer side "
                    "counts. <b>Waves</b> are as long as 2 pi times the square root of mean square "
                    "slope over mean square curvature, which of one sine is its wave length; a map "
                    "is measured as it tiles. Where waves are shorter than the footprint, the "
                    "picture cannot show them: the look tells by how much they vary, if its "
                    "filter does."));
}

}  // namespace limpid

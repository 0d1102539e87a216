#include <algorithm>
#include <array>

#include "judge/compare/compare.h"
#include "judge/compare/number_text.h"

namespace limpid {
namespace {

std::string place(const Comparison& comparison, const Offender& at) {
  return "(" + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " +
         comparison.names[static_cast<std::size_t>(at.channel)] + ")  values are " +
         number_text(at.a) + " vs " + number_text(at.b);
}

std::string over(const Metrics& metrics) {
  return std::to_string(metrics.over) + " pixels (" + number_text(metrics.over_percent) + "%)";
}

std::string line_of_table(const std::array<std::string, 9>& cells, std::size_t first_width) {
  std::string line = "  " + cells[0] + std::string(first_width - cells[0].size(), ' ');
  for (std::size_t i = 1; i < cells.size(); ++i) {
    line += std::string(cells[i].size() < 12 ? 12 - cells[i].size() : 1, ' ') + cells[i];
  }
  return line + "\n";
}

std::string table(const Comparison& comparison) {
  std::size_t width = 7;
  for (const std::string& name : comparison.names) width = std::max(width, name.size());
  std::string text = line_of_table(
      {"channel", "mean", "RMS", "rel. MSE", "PSNR", "max", "50%", "99%", "99.99%"}, width);
  for (std::size_t c = 0; c < comparison.names.size(); ++c) {
    const Metrics& m = comparison.channels[c];
    text += line_of_table({comparison.names[c], number_text(m.mean), number_text(m.rmse),
                           number_text(m.rel_mse), number_text(m.psnr), number_text(m.max),
                           number_text(m.p50), number_text(m.p99), number_text(m.p99_99)},
                          width);
  }
  return text;
}

}  // namespace

std::string numbers_text(const Comparison& comparison) {
  const Metrics& all = comparison.overall;
  const CompareOptions& options = comparison.options;
  const Tolerance& tolerance = options.tolerance;
  std::string text = "  Mean error = " + number_text(all.mean) +
                     "\n  RMS error = " + number_text(all.rmse) +
                     "\n  Relative MSE = " + number_text(all.rel_mse) + " (epsilon " +
                     number_text(options.epsilon) + ")\n  Peak SNR = " + number_text(all.psnr) +
                     "\n  Max error = " + number_text(all.max);
  if (all.max > 0) text += " @ " + place(comparison, all.max_at);
  text += "\n  Percentiles = " + number_text(all.p50) + " (50%), " + number_text(all.p99) +
          " (99%), " + number_text(all.p99_99) + " (99.99%)\n";
  if (options.clip) text += "  Values above " + number_text(*options.clip) + " count as that\n";
  if (all.both_nan > 0) text += "  " + std::to_string(all.both_nan) + " values are NaN in both\n";
  if (all.mismatches > 0) {
    text += "  " + std::to_string(all.mismatches) + " values are NaN or inf in one picture only\n";
  }
  text += table(comparison);
  text += "  " + over(all) + " over " + number_text(tolerance.per_pixel) + "; allowed " +
          number_text(tolerance.allowed_percent) + "%, none over " +
          number_text(tolerance.hard_limit) + "\n";
  for (const Offender& offender : comparison.offenders) {
    text += "    " + place(comparison, offender) + "\n";
  }
  return text;
}

std::string to_text(const Comparison& comparison) {
  return numbers_text(comparison) + (within(comparison) ? "PASS\n" : "FAILURE\n");
}

}  // namespace limpid

#include <cstdarg>
#include <cstdio>

#include "limpid/plan/survey.h"

#include "plan/cell_rules.h"
#include "plan/predict.h"
#include "plan/rules.h"

namespace limpid {
namespace {

[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  char text[320];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

std::string bound_text(double bound) {
  return bound > 0 ? line("no channel of a pixel changes by more than %.2g", bound)
                   : "it changes no bit of the picture";
}

std::string kind_text(const char* name, const CellCount& count, const CellCount& all,
                      const char* about) {
  const double share =
      all.pixels > 0 ? 100.0 * static_cast<double>(count.pixels) / static_cast<double>(all.pixels)
                     : 0;
  return line("  %-18s%6d %6.1f %%  %s\n", name, count.cells, share, about);
}

std::string cells_text(const Plan& plan, const Survey::Summary& s) {
  const double wet =
      s.all.pixels > 0 ? 100.0 * static_cast<double>(s.wet) / static_cast<double>(s.all.pixels) : 0;
  std::string text = line("cells of %dx%d pixels, %.1f %% of them wet\n", Survey::kCell.width,
                          Survey::kCell.height, wet);
  text += kind_text("all", s.all, s.all, "");
  text += kind_text("dry", s.dry, s.all, "no water: copied");
  text +=
      kind_text("opaque", s.opaque, s.all, "fog hides the end of the path: nothing is refracted");
  text +=
      kind_text("foreground-free", s.open, s.all, "no object in reach is in front of the water");
  for (std::size_t i = 0; i < operator_table().size(); ++i) {
    const CellKind& kind = operator_table()[i].skipped;
    if (kind.name.empty()) continue;
    text += kind_text(std::string(kind.name).c_str(), s.skipped[i], s.all,
                      std::string(kind.about).c_str());
  }
  text += kind_text("full", s.full, s.all, "all of the plan runs");
  if (plan.max_error > 0) {
    text += line("max_error %g: no pixel has an error above %.2g\n", plan.max_error, s.bound);
  }
  return text;
}

std::string time_text(const Plan& plan, const Survey::Summary& s, std::span<const double> seconds) {
  std::string text =
      line("%-20s%9s%14s%14s\n", "time", "runs in", "predicted", seconds.empty() ? "" : "measured");
  double total = 0, measured = 0;
  const auto add = [&](const char* name, const CellCount& runs, double ms, std::size_t index) {
    const double share = s.all.pixels > 0 ? 100.0 * static_cast<double>(runs.pixels) /
                                                static_cast<double>(s.all.pixels)
                                          : 0;
    text += line("  %-18s%7.1f %%%11.3f ms", name, share, ms);
    if (index < seconds.size()) {
      text += line("%11.3f ms", 1e3 * seconds[index]);
      measured += seconds[index];
    }
    text += "\n";
    total += ms;
  };
  for (int i = 0; i < Chain::kCount; ++i) {
    if (!plan.keeps(i)) continue;
    const auto index = static_cast<std::size_t>(i);
    const CellCount& runs = s.runs[index];
    add(std::string(plan.operators[index].name).c_str(), runs,
        1e-6 * predicted_ns(plan, i) * static_cast<double>(runs.pixels), index);
  }
  const auto wet = static_cast<double>(s.all.pixels - s.dry.pixels);
  add("all else", s.all,
      1e-6 * (kPredictedWetNs * wet + kPredictedDryNs * static_cast<double>(s.dry.pixels)),
      Chain::kCount);
  text += line("  %-18s%9s%11.3f ms", "sum", "", total);
  if (!seconds.empty()) text += line("%11.3f ms", 1e3 * measured);
  return text + "\n";
}

}  // namespace

std::vector<PlannedOperator> operators_seen(const Plan& plan, const Survey& survey) {
  std::vector<PlannedOperator> operators = plan.operators;
  const Survey::Summary& s = survey.summary();
  for (int i = 0; i < Chain::kCount; ++i) {
    const auto index = static_cast<std::size_t>(i);
    PlannedOperator& op = operators[index];
    if (!plan.keeps(i) || s.runs[index].cells > 0) continue;
    op.verdict = Verdict::kInvisible;
    op.reason = bound_text(s.by_bound.bounds[index]);
    op.rule = name_of(&CellRules::skip_invisible);
    if (s.dry.cells == s.all.cells) {
      op.reason = "no pixel is wet";
      op.rule = name_of(&CellRules::copy_dry);
    } else if (operator_table()[index].makes.has(StatePart::kPosition) && s.opaque.cells > 0) {
      op.reason = "fog hides its effect, " + op.reason;
      op.rule = name_of(&CellRules::skip_hidden);
    } else if (((s.by_bound.operators >> i) & 1u) == 0) {
      op.verdict = Verdict::kUnread;
      op.reason = "no running operator of a cell reads its results";
      op.rule = name_of(&CellRules::skip_unread);
    }
  }
  return operators;
}

std::string to_text(const Plan& plan, const Survey& survey, std::span<const double> seconds) {
  std::string text;
  for (const PlannedOperator& op : operators_seen(plan, survey)) {
    text += line("%-20s", std::string(op.name).c_str()) + to_text(op);
    if (!op.rule.empty()) text += " [" + std::string(op.rule) + "]";
    text += "\n";
  }
  return text + cells_text(plan, survey.summary()) + time_text(plan, survey.summary(), seconds);
}

}  // namespace limpid

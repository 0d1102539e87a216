#include <algorithm>
#include <array>

#include "limpid/run/fused.h"

#include "judge/report/choices.h"
#include "judge/report/lagoon.h"
#include "judge/report/measure.h"
#include "judge/report/numbers.h"
#include "judge/report/rounds.h"

namespace limpid {
namespace {

// ---- refraction against the truth

/// The models whose picture the page shows.
constexpr std::array<std::string_view, 4> kShown = {
    "no refraction", "snell steps 0, snap", "snell steps 2, shorten", "snell march, shorten"};

void draw_truth(const Measuring& m, const Lagoon& lagoon, const std::string& variant,
                const Picture& picture) {
  if (std::find(kShown.begin(), kShown.end(), variant) == kShown.end()) return;
  m.report.truth_errors.push_back(heat_figure_of(variant, variant + ", difference from the truth",
                                                 picture.color(), lagoon.truth()));
  if (variant == kShown.back()) {
    m.report.truth_figures.push_back(figure_of(variant, variant, picture.color()));
  }
}

}  // namespace

void measure_truth(const Measuring& m) {
  const Lagoon lagoon(m.options.data / "plates" / "lagoon");
  Report& report = m.report;
  report.truth_size = lagoon.window().size();
  report.truth_in_frame_share = lagoon.in_frame_share();
  report.truth_figures = {figure_of("dry", "the dry picture", lagoon.dry()),
                          figure_of("truth", "path-traced with the water", lagoon.truth())};
  const TruthError dry = lagoon.error_of(lagoon.dry());
  report.truth.push_back({"the dry picture", 0, dry.wet, dry.in_frame});

  const Picture picture(lagoon.window());
  const std::vector<Lagoon::Refracted> variants = Lagoon::refraction_variants();
  std::vector<Plan> plans;
  for (const Lagoon::Refracted& variant : variants) plans.push_back(lagoon.plan(variant.look));
  std::vector<Timed> timed;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    timed.push_back({[&, i] { lagoon.run(plans[i], picture.target, m.one, m.simd); }});
    timed[i].run();
    const TruthError error = lagoon.error_of(picture.color());
    report.truth.push_back({variants[i].name, 0, error.wet, error.in_frame});
    draw_truth(m, lagoon, variants[i].name, picture);
  }
  time_rounds(timed, m.options.rounds);
  const double pixels = static_cast<double>(lagoon.window().area());
  for (std::size_t i = 0; i < variants.size(); ++i) {
    TruthRow& row = report.truth[i + 1];
    row.ns_per_pixel = 1e9 * timed[i].best_seconds / pixels;
    m.say("truth, " + row.choice + ": " + short_number(row.ns_per_pixel) + " ns/pixel, error " +
          short_number(row.wet) + ", in frame " + short_number(row.in_frame));
  }
}

// ---- variants of the look physical

void measure_choices(const Measuring& m, Subject& subject) {
  std::vector<Choice> list = choices_of(m.physical);
  list.insert(list.begin(), {"", "", m.physical});
  m.report.choices_subject = subject.facts().name;
  std::vector<Plan> plans;
  std::vector<Frame> frames;
  for (const Choice& choice : list) {
    plans.push_back(subject.plan(choice.look));
    frames.push_back(subject.frame_for(plans.back()));
  }
  Picture judge(subject.window()), picture(subject.window());
  std::vector<Timed> timed;
  std::vector<ChoiceRow> rows;
  for (std::size_t i = 0; i < list.size(); ++i) {
    timed.push_back({[&, i] {
      run_fused(plans[i], frames[i], subject.scene(), picture.target, m.one, {.simd = m.simd});
    }});
    timed[i].run();
    if (i == 0)
      run_fused(plans[0], frames[0], subject.scene(), judge.target, m.many, {.simd = m.simd});
    rows.push_back({list[i].parameter, list[i].value, 0, error_of(picture, judge, true)});
  }
  time_rounds(timed, m.options.rounds);
  for (std::size_t i = 0; i < list.size(); ++i) {
    ChoiceRow& row = rows[i];
    row.ns_per_pixel = 1e9 * timed[i].best_seconds / subject.pixels();
    m.say(subject.facts().name + ", " +
          (i == 0 ? m.physical.name + " unchanged" : row.parameter + " = " + row.value) + ": " +
          costs_text(row.ns_per_pixel, row.error));
    m.report.choices.push_back(row);
  }
}

}  // namespace limpid

// Looks, and variants of the look physical, against ray-traced truth.
#include <algorithm>
#include <span>

#include "limpid/files/gltf/gltf.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/run/fused.h"

#include "judge/compare/flip.h"
#include "judge/compare/offset.h"
#include "judge/compare/ssim.h"
#include "judge/compare/temporal.h"
#include "judge/report/choices.h"
#include "judge/report/lagoon.h"
#include "judge/report/measure.h"
#include "judge/report/numbers.h"
#include "judge/report/rounds.h"
#include "judge/trace/truth.h"

namespace limpid {
namespace {

constexpr double kFrameSeconds = 1.0 / 24;
constexpr Aov kStmaps[] = {Aov::kStmapR, Aov::kStmapG, Aov::kStmapB};
constexpr Aov kGeometry[] = {Aov::kStmapR, Aov::kStmapG, Aov::kStmapB, Aov::kConfidence,
                             Aov::kSurfaceDepth};

ColorViews color_of(const Target& target) {
  return {target.color[0], target.color[1], target.color[2]};
}

std::vector<ComparedChannel> channels_of(const ColorViews& a, const ColorViews& b) {
  return {{"R", a[0], b[0]}, {"G", a[1], b[1]}, {"B", a[2], b[2]}};
}

/// A picture with the places of its lookups.
struct Traced {
  Picture picture;
  std::vector<Plane> planes;

  explicit Traced(Rect window) : picture(window) {
    for (const Aov aov : kGeometry) {
      for (std::size_t i = 0; i < aovs()[static_cast<std::size_t>(aov)].suffixes.size(); ++i) {
        planes.emplace_back(window);
        picture.target.of(aov)[i] = planes.back().view();
      }
    }
  }
};

/// A scene at one time: the chain's input, and its truth.
struct Moment {
  Subject subject;
  TruthPicture truth;

  Moment(const Measuring& m, const std::filesystem::path& file, const Model& model, double time)
      : subject(Subject::of_scene(file, m.options.size, m.options.data / "maps" / "sky.exr", m.many,
                                  time)) {
    const Frame frame = subject.frame_for(subject.plan(m.physical));
    TruthOptions options;
    options.size = m.options.size;
    options.light = TruthOptions::Light::kOnce;
    options.aovs.assign(std::begin(kStmaps), std::end(kStmaps));
    options.visible = true;
    options.wave_map = frame.wave_map;
    options.environment = frame.environment;
    truth = trace_truth(model, subject.scene(), m.physical, options, m.many);
  }
};

class Beside {
 public:
  Beside(const Measuring& m, const std::filesystem::path& file, const Model& model)
      : m_(m),
        now_(m, file, model, Subject::kMoment),
        next_(m, file, model, Subject::kMoment + kFrameSeconds),
        exposures_(exposures_of(color_of(now_.truth.target))) {}

  void add(const Look& look, const std::string& parameter, const std::string& value) {
    ModelRow row;
    row.subject = now_.subject.facts().name;
    row.look = look.name;
    row.parameter = parameter;
    row.value = value;
    rows_.push_back(row);
    looks_.push_back(look);
  }

  void measure() {
    for (std::size_t i = 0; i < rows_.size(); ++i) judge(looks_[i], rows_[i]);
    time();
    for (ModelRow& row : rows_) {
      m_.say(row.subject + " against its truth, " +
             (row.parameter.empty() ? row.look : row.parameter + " = " + row.value) + ": " +
             costs_text(row.ns_per_pixel, row.error) + ", FLIP " + short_number(row.flip) +
             ", lookups off by " + short_number(row.offset_median) + " pixels");
      m_.report.models.push_back(row);
    }
    draw();
  }

 private:
  Traced run(Moment& moment, const Look& look) {
    const Plan plan = moment.subject.plan(look, 0, state_shown_by(kGeometry));
    Traced traced(moment.subject.window());
    run_fused(plan, moment.subject.frame_for(plan), moment.subject.scene(), traced.picture.target,
              m_.many, {.simd = m_.simd});
    return traced;
  }

  void judge(const Look& look, ModelRow& row) {
    const Traced now = run(now_, look), next = run(next_, look);
    const ColorViews truth = color_of(now_.truth.target);
    const auto channels = channels_of(now.picture.color(), truth);
    CompareOptions options;
    options.clip = Lagoon::kBrightest;
    const Metrics all = compare(channels, options).overall;
    row.error = {all.mean, all.p99, all.p99_99, all.max};
    row.rmse = all.rmse;
    row.rel_mse = all.rel_mse;
    const ColorPair pair{now.picture.color(), truth};
    row.ssim = ssim(pair).mean;
    row.flip = flip(pair).mean;
    row.hdr_flip = hdr_flip(pair, exposures_).mean;
    row.flicker = flicker(channels, channels_of(next.picture.color(), color_of(next_.truth.target)),
                          options.clip)
                      .mean;
    const OffsetErrors offset = offset_of(now);
    row.offset_median = offset.median;
    row.offset_p95 = offset.p95;
    row.wrongly_rejected = offset.wrongly_rejected;
    row.wrongly_accepted = offset.wrongly_accepted;
  }

  /// Lookups read the layer below the water, if there is one.
  OffsetErrors offset_of(const Traced& traced) const {
    const Target& ours = traced.picture.target;
    OffsetPictures pictures;
    pictures.display = now_.subject.window().size();
    pictures.surface_depth = ours.of(Aov::kSurfaceDepth)[0];
    pictures.confidence = ours.of(Aov::kConfidence)[0];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& mine = ours.of(kStmaps[c]);
      const auto& its = now_.truth.target.of(kStmaps[c]);
      pictures.channels[c] = {mine[0], mine[1], its[0], its[1], now_.truth.visible_below[c]};
    }
    return offset_errors(pictures).overall;
  }

  void time() {
    Picture scratch(now_.subject.window());
    std::vector<Plan> plans;
    std::vector<Frame> frames;
    std::vector<Timed> timed;
    for (const Look& look : looks_) {
      plans.push_back(now_.subject.plan(look));
      frames.push_back(now_.subject.frame_for(plans.back()));
    }
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      timed.push_back({[&, i] {
        run_fused(plans[i], frames[i], now_.subject.scene(), scratch.target, m_.one,
                  {.simd = m_.simd});
      }});
    }
    time_rounds(timed, m_.options.rounds);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i].ns_per_pixel = 1e9 * timed[i].best_seconds / now_.subject.pixels();
    }
  }

  void draw() {
    const std::string& name = now_.subject.facts().name;
    const ColorViews truth = color_of(now_.truth.target);
    m_.report.model_figures.push_back(figure_of(name, name + ", traced", truth));
    m_.report.model_errors.push_back(heat_figure_of(name, m_.physical.name + ", difference",
                                                    run(now_, m_.physical).picture.color(), truth));
  }

  const Measuring& m_;
  Moment now_, next_;
  Exposures exposures_;
  std::vector<ModelRow> rows_;
  std::vector<Look> looks_;
};

}  // namespace

void measure_models(const Measuring& measuring, const std::filesystem::path& scene_file,
                    bool choices) {
  const Measuring m = scattered_once(measuring);
  const Model model = load_gltf(load_scene(scene_file).geometry);
  Beside beside(m, scene_file, model);
  for (const Look& look : m.looks) beside.add(look, "", "");
  if (choices) {
    for (const Choice& choice : choices_of(m.physical)) {
      beside.add(choice.look, choice.parameter, choice.value);
    }
  }
  beside.measure();
}

}  // namespace limpid

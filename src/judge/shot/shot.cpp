#include "judge/shot/shot.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/core/simd.h"

#include "job/composite_inputs.h"
#include "job/picture_warnings.h"
#include "judge/compare/heat_map.h"
#include "judge/report/differences.h"
#include "judge/report/measure.h"
#include "judge/report/now.h"
#include "judge/report/numbers.h"
#include "judge/shot/shot_error.h"
#include "judge/shot/shot_files.h"
#include "judge/shot/shot_variants.h"
#include "show/encoded.h"
#include "show/shown.h"

namespace limpid {
namespace {

constexpr double kMilliseconds = 1e3;

bool same_parameters(const Look& a, const Look& b) {
  const std::vector<Parameter> ours = parameters(a), theirs = parameters(b);
  return std::equal(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                    [](const Parameter& x, const Parameter& y) { return x.value == y.value; });
}

View<const float> cropped(View<const float> view, const Rect& to) {
  view.data = &view.at(to.x0, to.y0);
  view.window = to;
  return view;
}

/// Planes for red, green and blue of a picture.
struct Color {
  explicit Color(const Target& target) {
    for (std::size_t c = 0; c < 3; ++c) {
      const View<float> from = target.color[c];
      planes[c] = Plane(from.window);
      for (int y = from.window.y0; y < from.window.y1; ++y) {
        std::copy_n(from.row(y), from.window.width(), planes[c].view().row(y));
      }
    }
  }
  ColorViews views() const { return {planes[0].view(), planes[1].view(), planes[2].view()}; }

  std::array<Plane, 3> planes;
};

std::array<ComparedChannel, 3> channels_of(const ColorViews& picture, const ColorViews& judge) {
  return {{{"R", picture[0], judge[0]}, {"G", picture[1], judge[1]}, {"B", picture[2], judge[2]}}};
}

/// The truth within the window. Throws Error if its size differs.
ColorViews fitting(const ShotTruth& truth, const Rect& window) {
  ColorViews views;
  const auto text = [](Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    views[c] = truth.color[c].view();
    const bool same = truth.display == window.size();
    if (!same || !views[c].window.contains(window)) {
      throw Error(truth.name + ": is " + text(truth.display) +
                  (same ? " and lacks a part of it" : "") + ": expected the plate's " +
                  text(window.size()) + " pixels");
    }
    views[c] = cropped(views[c], window);
  }
  return views;
}

std::vector<std::string> kept_by(const Plan& plan) {
  std::vector<std::string> names;
  for (int i = 0; i < Chain::kCount; ++i) {
    if (plan.keeps(i)) names.emplace_back(plan.operators[i].name);
  }
  return names;
}

}  // namespace

struct ShotMeasurement::Parts {
  Parts(ShotOptions chosen, Executor& on);

  Shot measure(const PictureSink& put_out);

  void describe(const ShotVariant& own);
  void measure_aovs();
  void show_plate(const ShotVariant& own);
  void measure_looks(std::vector<ShotVariant>& looks);
  void judge_fast(const std::vector<ShotVariant>& looks, const std::vector<Color>& colors);
  void measure_operators(const ShotVariant& own);
  RunTimes operator_times(const ShotVariant& own);

  void put(ShotPicture picture, const Shown& shown);
  ShotError error_of(const ColorViews& color, const ColorViews& judge) const {
    return shot_error(color, judge, wet, variants.scene().primaries);
  }
  DisplayTransform display() const { return DisplayTransform({}, variants.scene().primaries); }
  void put_light(const ShotPicture& picture, const ColorViews& color) {
    put(picture, shown_light(color, display(), executor));
  }
  void put_difference(ShotPicture picture, const ColorViews& color, const ColorViews& judge);
  /// Paints a variant with one AOV.
  std::array<View<float>, 3> painted(Aov aov);
  std::optional<ShotError> beside_truth(const ColorViews& color) const {
    if (!options.truth) return {};
    return error_of(color, truth);
  }
  void say(const std::string& what, double milliseconds, const ShotError& error) const;

  ShotOptions options;
  Executor& executor;
  ShotVariants variants;
  ColorViews truth{};
  const PictureSink* sink = nullptr;
  Shot shot;
  WetMask wet;
  std::optional<Color> whole;  ///< the picture of the shot
};

ShotMeasurement::Parts::Parts(ShotOptions chosen, Executor& on)
    : options(std::move(chosen)), executor(on), variants(options.job, on) {
  if (options.job.output.runner != Runner::kFused) {
    throw Error("runner " + std::string(runner_name(options.job.output.runner)) +
                    ": expected fused, the only runner that times operators",
                Fault::kUsage);
  }
  if (options.rounds < 1 || options.rounds > kMaxRounds) {
    throw Error("rounds = " + std::to_string(options.rounds) + ": expected 1 ... " +
                    std::to_string(kMaxRounds),
                Fault::kUsage);
  }
  variants.planned("", options.job.look);  // throws for an invalid plate or look
  depth_of(options.job);
  if (options.truth) truth = fitting(*options.truth, variants.window());
}

void ShotMeasurement::Parts::say(const std::string& what, double milliseconds,
                                 const ShotError& error) const {
  if (!options.progress) return;
  options.progress(what + ": " + short_number(milliseconds) + " ms, differs by " +
                   short_number(error.pixels.mean) + ", FLIP " + short_number(error.flip));
}

// --- pictures ---

void ShotMeasurement::Parts::put(ShotPicture picture, const Shown& shown) {
  picture.scale = shown.scale;
  (*sink)(picture, png_of(shown));
  shot.pictures.push_back(std::move(picture));
}

void ShotMeasurement::Parts::put_difference(ShotPicture picture, const ColorViews& color,
                                            const ColorViews& judge) {
  picture.group = "differences";
  const std::array<Plane, 3> map =
      heat_map(channels_of(color, judge), {.maximum = 1, .decades = kHeatDecades});
  Shown shown = shown_encoded({map[0].view(), map[1].view(), map[2].view()}, executor);
  put(std::move(picture), shown);
}

std::array<View<float>, 3> ShotMeasurement::Parts::painted(Aov aov) {
  std::vector<ShotVariant> one{variants.planned("", options.job.look, {aov})};
  variants.read(one);
  return variants.run(one[0]).of(aov);
}

// --- properties of the shot ---

void ShotMeasurement::Parts::describe(const ShotVariant& own) {
  shot.made = now_text();
  shot.machine = this_machine();
  shot.build = this_build();
  for (const auto& file : files_of(own.job.plate)) shot.files.push_back(file.filename().string());
  shot.scene = std::filesystem::path(own.job.scene.file).filename().string();
  shot.look = own.name;
  shot.truth = options.truth ? options.truth->name : "";
  shot.size = variants.window().size();
  shot.time = variants.scene().time;
  shot.rounds = options.rounds;
  const int cores = std::max(1, shot.machine.cores);
  shot.threads = options.threads == 0 ? cores : std::min(options.threads, cores);
  shot.samples = own.job.output.wave_samples;
  shot.simd = own.job.output.simd.empty() ? simd_targets().front() : own.job.output.simd;
  shot.warnings = warnings_of(own.job, variants.plate(), own.plan);
  warn_of_pixels(own.job, own.plan, own.frame, variants.scene(), variants.transparent(),
                 shot.warnings);
  shot.off_frame = off_frame_lookups_of(own.plan, own.frame, variants.scene());
}

/// One AOV at a time, because all AOVs of a large picture would need much memory. Finds the wet
/// pixels, too.
void ShotMeasurement::Parts::measure_aovs() {
  const Rect w = variants.window();
  const View<float> surface = painted(Aov::kSurfaceDepth)[0];
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) wet.push_back(std::isfinite(surface.at(x, y)) ? 1 : 0);
  }
  const double count = std::accumulate(wet.begin(), wet.end(), 0.0);
  shot.wet_share = count / static_cast<double>(w.area());
  for (const AovInfo& info : aovs()) {
    const Aov aov = aov_named(info.name);
    const std::array<View<float>, 3> views = painted(aov);
    if (aov == Aov::kConfidence) {
      double sum = 0, guessed = 0;
      auto is_wet = wet.begin();
      for (int y = w.y0; y < w.y1; ++y) {
        for (int x = w.x0; x < w.x1; ++x, ++is_wet) {
          if (!*is_wet) continue;
          sum += views[0].at(x, y);
          guessed += views[0].at(x, y) < 0.5f ? 1 : 0;
        }
      }
      shot.confidence_mean = sum / count;
      shot.guessed_share = guessed / count;
    }
    const std::string name(info.name);
    put({aov_file(name), name, std::string(info.about), "aovs"},
        shown_aov(aov, views, display(), executor));
  }
}

void ShotMeasurement::Parts::show_plate(const ShotVariant& own) {
  ColorViews dry{};
  for (int c = 0; c < 3; ++c) {
    dry[c] = cropped(own.frame.plane(plane_after(PlaneId::kColorR, c)), variants.window());
  }
  put_light({kDryFile, "dry", "the dry plate", "pictures"}, dry);
  put_light({kWetFile, "wet", "with the look " + own.name, "pictures"}, whole->views());
  if (options.truth) {
    put_light({kTruthFile, "truth", options.truth->name, "pictures"}, truth);
    put_difference({difference_file(kTruthFile), "wet and truth", "their difference", ""},
                   whole->views(), truth);
  }
  shot.dry = {"dry", kDryFile, std::nan(""), error_of(dry, whole->views()), beside_truth(dry), {}};
}

// --- speed and error ---

void ShotMeasurement::Parts::measure_looks(std::vector<ShotVariant>& looks) {
  variants.time(looks, options.rounds);
  std::vector<Color> colors;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const ShotVariant& variant = looks[i];
    colors.emplace_back(variants.run(variant));
    const ColorViews color = colors.back().views();
    std::string file = kWetFile;
    if (i > 0) {
      file = look_file(i);
      put_light({file, variant.name, "with the look " + variant.name, "pictures"}, color);
      put_difference({difference_file(file), variant.name + " and wet", "their difference", ""},
                     color, whole->views());
    }
    ShotLook row{variant.name,
                 file,
                 kMilliseconds * variant.seconds,
                 error_of(color, whole->views()),
                 beside_truth(color),
                 differences(variant.plan, looks[0].plan)};
    say("look " + row.name, row.milliseconds, row.error);
    shot.looks.push_back(std::move(row));
  }
  judge_fast(looks, colors);
}

void ShotMeasurement::Parts::judge_fast(const std::vector<ShotVariant>& looks,
                                        const std::vector<Color>& colors) {
  const auto place_of = [&](const char* name) {
    const auto at = std::find_if(looks.begin(), looks.end(),
                                 [&](const ShotVariant& variant) { return variant.name == name; });
    return static_cast<std::size_t>(at - looks.begin());
  };
  const std::size_t fast = place_of("fast"), physical = place_of("physical");
  if (std::max(fast, physical) >= looks.size()) return;
  shot.fast_error = error_of(colors[fast].views(), colors[physical].views());
  shot.fast_time_share = looks[fast].seconds / looks[physical].seconds;
}

/// The times of the run with the least sum.
RunTimes ShotMeasurement::Parts::operator_times(const ShotVariant& own) {
  const auto sum = [](const RunTimes& times) {
    return std::accumulate(times.operators.begin(), times.operators.end(), times.rest);
  };
  RunTimes best;
  for (int round = 0; round < options.rounds; ++round) {
    RunTimes times;
    variants.run(own, &times);
    if (round == 0 || sum(times) < sum(best)) best = times;
  }
  return best;
}

void ShotMeasurement::Parts::measure_operators(const ShotVariant& own) {
  const RunTimes times = operator_times(own);
  shot.rest_milliseconds = kMilliseconds * times.rest;
  std::vector<ShotVariant> chains{own};  // the whole chain, and the chain without each operator
  for (const std::string& name : kept_by(own.plan)) {
    chains.push_back(variants.planned(name, options.job.look, {}, {name}));
  }
  variants.read(chains);
  variants.time(chains, options.rounds);
  shot.chain_milliseconds = kMilliseconds * chains[0].seconds;
  auto left = chains.begin() + 1;
  for (int i = 0; i < Chain::kCount; ++i) {
    const PlannedOperator& op = own.plan.operators[i];
    ShotOperator row;
    row.name = op.name;
    row.planned = to_text(op);
    row.runs = own.plan.keeps(i);
    if (row.runs) {
      const Color color(variants.run(*left));
      row.milliseconds = kMilliseconds * times.operators[static_cast<std::size_t>(i)];
      row.without_milliseconds = kMilliseconds * left->seconds;
      for (int j = 0; j < Chain::kCount; ++j) {
        if (j != i && own.plan.keeps(j) && !left->plan.keeps(j)) {
          row.falls.emplace_back(own.plan.operators[j].name);
        }
      }
      row.picture = without_file(row.name);
      row.difference = difference_file(row.picture);
      put_light({row.picture, "without " + row.name, "the picture without it", "without"},
                color.views());
      put_difference(
          {row.difference, "change by " + row.name, "the difference of the picture without it", ""},
          color.views(), whole->views());
      row.error = error_of(color.views(), whole->views());
      row.truth = beside_truth(color.views());
      say("without " + row.name, row.without_milliseconds, row.error);
      ++left;
    }
    shot.operators.push_back(std::move(row));
  }
}

Shot ShotMeasurement::Parts::measure(const PictureSink& put_out) {
  sink = &put_out;
  shot = {};
  wet.clear();
  std::vector<ShotVariant> looks{variants.planned(options.job.look.name, options.job.look)};
  for (const Look& look : options.others) {
    if (!same_parameters(look, options.job.look))
      looks.push_back(variants.planned(look.name, look));
  }
  // The variant with most planes first, because reading more planes reads all again.
  variants.read(looks);
  measure_aovs();
  variants.read(looks);
  describe(looks[0]);
  whole.emplace(variants.run(looks[0]));
  show_plate(looks[0]);
  measure_looks(looks);
  std::vector<ShotVariant> own{variants.planned(options.job.look.name, options.job.look)};
  variants.read(own);
  measure_operators(own[0]);
  return std::move(shot);
}

ShotMeasurement::ShotMeasurement(ShotOptions options, Executor& executor)
    : parts_(std::make_unique<Parts>(std::move(options), executor)) {}

ShotMeasurement::~ShotMeasurement() = default;

std::size_t ShotMeasurement::others() const { return parts_->options.others.size(); }

Shot ShotMeasurement::measure(const PictureSink& sink) { return parts_->measure(sink); }

}  // namespace limpid

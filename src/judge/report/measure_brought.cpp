// Looks by the buffers of a plate, against pictures with the water and its waves.
#include <algorithm>
#include <cmath>
#include <limits>

#include "limpid/files/exr/exr_file.h"
#include "limpid/files/gltf/gltf.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/run/fused.h"

#include "judge/compare/flip.h"
#include "judge/report/brought.h"
#include "judge/report/lagoon.h"
#include "judge/report/measure.h"
#include "judge/report/numbers.h"
#include "judge/report/rounds.h"
#include "judge/trace/finer_water.h"
#include "judge/trace/truth.h"

namespace limpid {
namespace {

/// For Subject::of_plate(): takes every pixel.
constexpr Size kWhole{kMaxReportSide, kMaxReportSide};

double length_of_waves(const Scene& scene, const Look& look, const Frame& frame) {
  if (scene.has_waves()) return wave_length(scene.water->waves);
  if (!frame.wave_map) return std::nan("");  // calm
  return wave_length(frame.wave_map, look.of<WaveNormals>().tile_size);
}

/// A plate, its picture with water, and the pixels to judge.
struct Known {
  explicit Known(Subject plate) : subject(std::move(plate)) {}

  /// `frame` with the waves of the look.
  void judge_where(const Frame& frame, const Look& look,
                   const std::function<bool(int x, int y)>& wet) {
    wave_length = length_of_waves(subject.scene(), look, frame);
    places = places_of(subject.scene(), frame, wave_length, wet);
  }

  Subject subject;
  PlaneSet always;  ///< that every row brings
  ColorViews truth;
  std::vector<Place> places;
  double wave_length = 0;
};

/// Mean |picture - truth| over mean truth.
struct Sum {
  double off = 0, truth = 0;
  void add(double value, double right) {
    off += std::abs(value - right);
    truth += right;
  }
  double error() const { return truth > 0 ? off / truth : std::nan(""); }
};

/// The waves of a scene, if it has some, are those of the truth.
Look with_waves_of(const Scene& scene, Look look) {
  if (!scene.has_waves()) return look;
  look.of<WaveNormals>().model = WaveNormals::Model::kSines;
  look.of<WaveNormals>().strength = 1;
  return look;
}

class ByBrought {
 public:
  /// Looks with the water of the truth.
  ByBrought(const Measuring& m, Known& known, std::vector<Look> looks)
      : m_(m), known_(known), looks_(std::move(looks)), picture_(known.subject.window()) {}

  void measure(bool figures) {
    if (figures) show("truth", "path-traced with the water", known_.truth);
    for (const Look& look : looks_) {
      for (const Brought& step : brought_one_by_one(known_.subject.planes() - known_.always))
        runs_.push_back({look, step});
    }
    for (Run& run : runs_) judge(run, figures);
    time();
    tell();
  }

 private:
  struct Run {
    Look look;
    Brought step;
    Plan plan = {};
    Frame frame = {};
    BroughtRow row = {};
  };

  void run(const Run& run, Executor& executor) {
    run_fused(run.plan, run.frame, known_.subject.scene(), picture_.target, executor,
              {.simd = m_.simd});
  }

  void judge(Run& run, bool figures) {
    known_.subject.bring(run.step.all | known_.always);
    run.plan = known_.subject.plan(run.look);
    run.frame = known_.subject.frame_for(run.plan);
    this->run(run, m_.many);
    run.row.subject = known_.subject.facts().name;
    run.row.look = run.look.name;
    run.row.brought = roles_text(run.step.added);
    sum_up(run.row);
    if (!figures || run.look.name != m_.physical.name) return;
    const bool first = run.step.added == run.step.all;
    show(run.row.brought, (first ? "" : "and ") + run.row.brought, picture_.color());
  }

  void sum_up(BroughtRow& row) const {
    const ErrorMap seen = flip({picture_.color(), known_.truth});
    Sum wet, near, far;
    double flip_sum = 0;
    std::int64_t count = 0;
    const Rect w = known_.subject.window();
    auto place = known_.places.begin();
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x, ++place) {
        if (*place == Place::kDry) continue;
        flip_sum += seen.map.view().at(x, y);
        ++count;
        for (std::size_t c = 0; c < 3; ++c) {
          const double value = std::min<double>(picture_.color()[c].at(x, y), Lagoon::kBrightest);
          const double right = std::min<double>(known_.truth[c].at(x, y), Lagoon::kBrightest);
          wet.add(value, right);
          (*place == Place::kNear ? near : far).add(value, right);
        }
      }
    }
    row.wet = wet.error();
    row.near = near.error();
    row.far = far.error();
    row.flip = flip_sum / static_cast<double>(count);
  }

  void time() {
    std::vector<Timed> timed;
    for (const Run& run : runs_) {
      timed.push_back({[&] { this->run(run, m_.one); }});
    }
    time_rounds(timed, m_.options.rounds);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      runs_[i].row.ns_per_pixel = 1e9 * timed[i].best_seconds / known_.subject.pixels();
    }
  }

  void tell() const {
    const auto number_of = [&](Place place) {
      return static_cast<double>(std::count(known_.places.begin(), known_.places.end(), place));
    };
    const double near = number_of(Place::kNear), wet = near + number_of(Place::kFar);
    m_.report.brought_subjects.push_back({known_.subject.facts().name, known_.wave_length,
                                          wet / known_.subject.pixels(), near / wet});
    for (const Run& run : runs_) {
      const BroughtRow& row = run.row;
      m_.say(row.subject + " by buffers, " + row.look + ", " +
             (run.step.added == run.step.all ? "" : "and ") + row.brought + ": " +
             short_number(row.ns_per_pixel) + " ns/pixel, error " + short_number(row.wet) +
             ", near " + short_number(row.near) + ", far " + short_number(row.far) + ", FLIP " +
             short_number(row.flip));
      m_.report.brought.push_back(row);
    }
  }

  void show(const std::string& name, const std::string& caption, const ColorViews& color) const {
    m_.report.brought_figures.push_back(figure_of(name, caption, color));
  }

  const Measuring& m_;
  Known& known_;
  std::vector<Look> looks_;
  std::vector<Run> runs_;
  Picture picture_;
};

/// The model of a scene. Its own grids of wide waters are too wide for their waves, so that a
/// picture by these waves would be judged by others.
Model fine_model(const Measuring& m, const std::filesystem::path& scene_file,
                 const SceneFile& file) {
  Model model = load_gltf(file.geometry);
  if (!file.scene.has_waves()) return model;
  const double shortest = shortest_wave(file.scene.water->waves);
  const Scene scene = Subject::scene_of(file, model, m.options.size);
  PartedWater parted =
      with_finer_water(std::move(model), {.shortest_wave = shortest, .eye = scene.camera->eye()});
  if (std::isfinite(parted.reach)) {
    m.say(scene_file.stem().string() + ": beyond " + short_number(parted.reach) +
          " scene units the traced water is calmer than its waves: it has " +
          std::to_string(parted.triangles) + " triangles, the maximum");
  }
  return std::move(parted.model);
}

/// The look physical and, at a lower price, fast: the others are other waters.
std::vector<Look> looks_of(const Measuring& m) {
  std::vector<Look> looks;
  for (const Look& look : m.looks) {
    if (look.name == m.physical.name || look.name == "fast") looks.push_back(look);
  }
  return looks;
}

}  // namespace

void measure_brought_lagoon(const Measuring& m) {
  const std::filesystem::path folder = m.options.data / "plates" / "lagoon";
  Known known(Subject::of_plate(folder / "lagoon.toml", kWhole));
  Subject& subject = known.subject;
  subject.make_waves(Lagoon::waves());
  // In the truth these waves tilt a flat plane. Without its depth they would raise the water.
  known.always = {PlaneId::kSurfaceDepth};
  const Rect window = subject.window();
  std::array<Plane, 3> truth{Plane(window), Plane(window), Plane(window)};
  ExrFile::open(folder / "truth_waves.exr")
      .read(std::vector<ExrRequest>{
          {0, "R", truth[0].view()}, {0, "G", truth[1].view()}, {0, "B", truth[2].view()}});
  known.truth = {truth[0].view(), truth[1].view(), truth[2].view()};
  std::vector<Look> looks = looks_of(m);
  for (Look& look : looks) look = with_waves_of(subject.scene(), Lagoon::with_its_water(look));
  const Frame frame = subject.frame_for(subject.plan(looks.front()));
  known.judge_where(frame, looks.front(), [&](int x, int y) {
    const float surface = frame.plane(PlaneId::kSurfaceDepth).at(x, y);
    return std::isfinite(surface) && surface < frame.plane(PlaneId::kDepth).at(x, y);
  });
  ByBrought(m, known, looks).measure(true);
}

void measure_brought_scene(const Measuring& measuring, const std::filesystem::path& scene_file) {
  const Measuring m = scattered_once(measuring);
  const SceneFile file = load_scene(scene_file);
  const Model model = fine_model(m, scene_file, file);
  Known known(Subject::of_model(scene_file, model, m.options.size, {}, m.many));
  Subject& subject = known.subject;
  std::vector<Look> looks = looks_of(m);
  for (Look& look : looks) look = with_waves_of(subject.scene(), look);
  const Frame frame = subject.frame_for(subject.plan(looks.front()));
  TruthOptions options;
  options.size = m.options.size;
  options.light = TruthOptions::Light::kOnce;
  options.samples = kBroughtSamples;
  options.aovs = {Aov::kPath};
  options.wave_map = frame.wave_map;
  const TruthPicture truth = trace_truth(model, subject.scene(), looks.front(), options, m.many);
  known.truth = {truth.target.color[0], truth.target.color[1], truth.target.color[2]};
  known.judge_where(frame, looks.front(),
                    [&](int x, int y) { return truth.target.of(Aov::kPath)[0].at(x, y) > 0; });
  ByBrought(m, known, looks).measure(false);
}

}  // namespace limpid

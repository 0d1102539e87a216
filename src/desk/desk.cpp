#include "desk/desk.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "limpid/core/simd.h"
#include "limpid/files/text/look_file.h"

#include "core/toml_text.h"
#include "job/composite_inputs.h"
#include "job/picture_warnings.h"
#include "job/stopwatch.h"
#include "judge/compare/shown_difference.h"

namespace limpid {
namespace {

constexpr const char* kPicture = "picture";
constexpr const char* kDry = "dry";
constexpr const char* kReference = "reference";
constexpr const char* kDifference = "difference";
constexpr const char* kCells = "cells";

constexpr const char* kPlain = "sRGB";

constexpr double kMilliseconds = 1e3;

ShownViews color_of(const Frame& frame) {
  return {frame.plane(PlaneId::kColorR), frame.plane(PlaneId::kColorG),
          frame.plane(PlaneId::kColorB)};
}

ShownViews color_of(const Canvas& canvas) {
  const auto& color = canvas.target().color;
  return {color[0], color[1], color[2]};
}

View<const float> cropped(View<const float> view, const Rect& to) {
  view.data = &view.at(to.x0, to.y0);
  view.window = to;
  return view;
}

ShownViews cropped(ShownViews views, const Rect& to) {
  for (View<const float>& view : views) view = cropped(view, to);
  return views;
}

/// The initial view first, and plain sRGB last.
std::vector<std::string> displays_of(const DisplayChoice& display) {
  std::vector<std::string> all;
  if (!display.config.empty()) all = display_views(display.config);
  const auto first = std::find(all.begin(), all.end(), display.view);
  if (first != all.end()) std::rotate(all.begin(), first, first + 1);
  all.emplace_back(kPlain);
  return all;
}

/// A unique text for each choice.
std::string text_of(const DeskChoice& choice) {
  std::string text = choice.look;
  for (const std::string& setting : choice.settings) text += "\n" + setting;
  if (choice.frame) text += "\nframe " + std::to_string(*choice.frame);
  if (choice.time) text += "\ntime " + toml_text(*choice.time);
  return text;
}

std::vector<ReplacedChoice> replaced_choices(const Look& asked, const Plan& plan) {
  std::vector<ReplacedChoice> replaced;
  const std::vector<Parameter> before = parameters(asked), after = parameters(plan.look);
  for (std::size_t i = 0; i < after.size(); ++i) {
    const Parameter& p = after[i];
    if (p.kind != FieldKind::kChoice || p.value == before[i].value) continue;
    std::string why;
    for (const PlannedOperator& op : plan.operators) {
      if (op.name == p.table) why = op.reason;
    }
    replaced.push_back(
        {std::string(p.table) + "." + std::string(p.name), to_string(p.value), std::move(why)});
  }
  return replaced;
}

std::vector<UnreadParameter> unread_parameters(const Plan& plan, const Frame& frame,
                                               const Scene& scene) {
  const std::string sky = sky_over_water(plan, frame, scene);
  if (sky.empty()) return {};
  return {{"depth_fog.ambient", sky + " lights the water"}};
}

}  // namespace

/// The result of a run; valid until the next one.
struct Desk::Painted {
  Frame frame;
  HeldTextures textures;      ///< of the frame
  std::optional<int> number;  ///< of the frame
  bool half = false;
  Halving halving;
  Rect display;  ///< of the plate
  Rect window;   ///< the computed window
  Primaries primaries = kRec709;
  const Canvas* canvas = nullptr;
  RunTimes times;
  double read_seconds = 0;
  std::vector<ReplacedChoice> replaced;
  std::vector<UnreadParameter> unread;
  std::vector<std::string> warnings, advice;
};

Desk::Desk(DeskOptions options, Executor& executor)
    : options_(std::move(options)), displays_(displays_of(options_.display)), executor_(executor) {
  const Facts first = facts();
  if (options_.reference) reference(first.frame, first.primaries);
}

DisplayTransform Desk::display_of(const PictureRequest& r, const Primaries& primaries) const {
  const std::string& name = r.display.empty() ? displays_.front() : r.display;
  if (std::find(displays_.begin(), displays_.end(), name) == displays_.end()) {
    throw Error("display = '" + name + "': expected one of " + join(displays_) +
                did_you_mean(name, displays_));
  }
  if (name == kPlain) return DisplayTransform({.exposure = r.exposure}, primaries);
  return DisplayTransform({r.exposure, options_.display.config, name}, primaries);
}

std::string Desk::runner() const {
  const OutputChoice output =
      options_
          .job_of(options_.frames.empty() ? std::nullopt : std::optional(options_.frames.front()))
          .output;
  const std::string name(runner_name(output.runner));
  if (output.runner != Runner::kFused) return name;
  return name + " " + (output.simd.empty() ? simd_targets().front() : output.simd);
}

std::vector<DeskShow> Desk::shows() const {
  std::vector<DeskShow> list = {{kPicture, "the picture with its water"}, {kDry, "the dry plate"}};
  if (options_.reference) {
    list.push_back({kReference, "the picture to compare with"});
    list.push_back({kDifference, "largest difference of a pixel's channels from the reference"});
  }
  if (runner().starts_with(runner_name(Runner::kFused))) {
    list.push_back({kCells,
                    "the kind of each cell of the picture: opaque water red, open water green, the "
                    "full chain yellow, other water blue"});
  }
  for (const AovInfo& info : aovs()) {
    list.push_back({std::string(info.name), std::string(info.about)});
  }
  return list;
}

const DeskLook& Desk::look_named(const std::string& word) const {
  std::vector<std::string> known;
  for (const DeskLook& look : options_.looks) {
    if (look.word == word) return look;
    known.push_back(look.word);
  }
  throw Error("look = '" + word + "': expected one of " + join(known) + did_you_mean(word, known));
}

Look Desk::look_of(const DeskChoice& choice) const {
  Look look = look_named(choice.look).look;
  apply_settings(look, choice.settings);
  return look;
}

DeskFrame& Desk::frame_at(std::optional<int> number) {
  const std::vector<int>& all = options_.frames;
  if (!number && !all.empty()) number = all.front();
  if (number && std::find(all.begin(), all.end(), *number) == all.end()) {
    throw Error("frame = " + std::to_string(*number) + ": expected " +
                (all.empty() ? "none, since there is only one picture" : "one of --frames"));
  }
  const auto kept = std::find_if(frames_.begin(), frames_.end(),
                                 [&](const Kept& frame) { return frame.number == number; });
  if (kept != frames_.end()) {
    frames_.splice(frames_.begin(), frames_, kept);
  } else {
    frames_.push_front({number, std::make_unique<DeskFrame>(options_.job_of(number))});
  }
  std::int64_t bytes = 0;
  for (auto frame = frames_.begin(); frame != frames_.end();) {
    bytes += frame->frame->bytes();
    const bool goes = frame != frames_.begin() && bytes > options_.most_bytes;
    frame = goes ? frames_.erase(frame) : std::next(frame);
  }
  return *frames_.front().frame;
}

CompositeJob Desk::job_for(const DeskFrame& frame, const DeskChoice& choice) const {
  CompositeJob job = frame.job();
  job.look = look_of(choice);
  if (choice.time) job.time.explicit_time = choice.time;
  return job;
}

void Desk::break_off() {
  const std::lock_guard lock(stop_mutex_);
  stop_.request_stop();
  stop_ = std::stop_source();
}

std::stop_token Desk::wanted() {
  const std::lock_guard lock(stop_mutex_);
  return stop_.get_token();
}

Desk::Painted Desk::run(const DeskChoice& choice, std::vector<Aov> aovs, bool half,
                        std::optional<Canvas>& canvas, const std::stop_token& stop) {
  expect_wanted(stop);
  Painted painted;
  Stopwatch watch;
  DeskFrame& held = frame_at(choice.frame);
  CompositeJob job = job_for(held, choice);
  job.output.aovs = std::move(aovs);
  Scene scene = scene_of(job, held.plate());
  const Plan plan = plan_of(job, held.plate(), scene);
  if (half) {
    const DeskFrame::Half smaller = held.half(plan.planes, scene, executor_);
    painted.frame = smaller.frame;
    scene.camera = smaller.camera;
  } else {
    painted.frame = held.whole(plan.planes, scene);
  }
  painted.textures = textures_.load(textures_read(plan, job.scene), job.plate.limits);
  painted.textures.show_in(painted.frame);
  painted.number = frames_.front().number;
  painted.half = half;
  painted.halving = held.halving();
  painted.display = held.plate().display();
  painted.window = painted.frame.work();
  painted.primaries = scene.primaries;
  painted.replaced = replaced_choices(job.look, plan);
  painted.unread = unread_parameters(plan, painted.frame, scene);
  painted.warnings = warnings_of(job, held.plate(), plan);
  if (!half) {
    warn_of_pixels(job, plan, painted.frame, scene, held.transparent(), painted.warnings);
    const OffFrameLookups off_frame = off_frame_lookups_of(plan, painted.frame, scene);
    if (off_frame.any()) painted.advice.push_back(to_text(off_frame));
  }
  painted.read_seconds = watch.lap();

  gpu_.name(job.output);
  canvas_for(canvas, painted.window, job.output)
      .paint(plan, painted.frame, scene, job.output, executor_, &painted.times, stop);
  painted.canvas = &*canvas;
  return painted;
}

const std::array<Plane, 3>& Desk::reference(std::optional<int> frame, const Primaries& primaries) {
  if (!reference_ || reference_->frame != frame) {
    reference_.reset();
    reference_ = Reference{frame, options_.reference(frame, primaries)};
  }
  return reference_->color;
}

ShownViews Desk::reference_beside(const Painted& painted, std::array<Plane, 3>& halved) {
  const Rect whole = painted.half
                         ? intersection(painted.halving.covered(painted.window), painted.display)
                         : painted.window;
  ShownViews views;
  for (std::size_t c = 0; c < 3; ++c) {
    views[c] = reference(painted.number, painted.primaries)[c].view();
    if (!views[c].window.contains(whole)) {
      throw Error("reference: expected a picture that covers the plate, " +
                  std::to_string(whole.width()) + "x" + std::to_string(whole.height()) + " pixels");
    }
    if (painted.half) {
      halved[c] = half_mean(views[c], painted.halving);
      views[c] = std::as_const(halved[c]).view();
    }
    views[c] = cropped(views[c], painted.window);
  }
  return views;
}

Shown Desk::show(const PictureRequest& r, const Painted& painted) {
  const ShownViews wet = color_of(*painted.canvas);
  const DisplayTransform display = display_of(r, painted.primaries);
  if (r.show == kPicture) return shown_light(wet, display, executor_);
  if (r.show == kDry) {
    return shown_light(cropped(color_of(painted.frame), painted.window), display, executor_);
  }
  if (r.show == kCells) return shown_cells(painted.canvas->survey(), wet, display, executor_);
  if (r.show == kReference || r.show == kDifference) {
    std::array<Plane, 3> halved;
    const ShownViews views = reference_beside(painted, halved);
    return r.show == kReference ? shown_light(views, display, executor_)
                                : shown_difference(wet, views, r.exposure, executor_);
  }
  const Aov aov = aov_named(r.show);
  return shown_aov(aov, painted.canvas->target().of(aov), display, executor_);
}

DeskPicture Desk::paint(const PictureRequest& request) {
  std::vector<std::string> known;
  for (const DeskShow& show : shows()) known.push_back(show.name);
  if (std::find(known.begin(), known.end(), request.show) == known.end()) {
    throw Error("show = '" + request.show + "': expected one of " + join(known) +
                did_you_mean(request.show, known));
  }
  std::vector<Aov> shown;
  for (const AovInfo& info : aovs()) {
    if (info.name == request.show) shown.push_back(aov_named(info.name));
  }

  const std::stop_token stop = wanted();
  const std::lock_guard lock(mutex_);
  Stopwatch watch;
  Painted painted = run(request, shown, request.half, request.half ? half_ : whole_, stop);
  DeskPicture picture;
  picture.shown = show(request, painted);
  picture.half = request.half;
  picture.replaced = std::move(painted.replaced);
  picture.unread = std::move(painted.unread);
  picture.warnings = std::move(painted.warnings);
  picture.advice = std::move(painted.advice);
  auto& times = picture.milliseconds;
  times.emplace_back("all", kMilliseconds * watch.lap());
  times.emplace_back("read", kMilliseconds * painted.read_seconds);
  if (!runner().starts_with(runner_name(Runner::kFused))) return picture;
  for (int i = 0; i < Chain::kCount; ++i) {
    times.emplace_back(operators()[i].name, kMilliseconds * painted.times.operators[i]);
  }
  times.emplace_back("rest", kMilliseconds * painted.times.rest);
  const auto wet = static_cast<double>(painted.canvas->survey().summary().wet);
  picture.wet = wet / static_cast<double>(painted.window.area());
  return picture;
}

PixelNumbers Desk::pixel(const DeskChoice& choice, int x, int y) {
  std::vector<Aov> all;
  for (const AovInfo& info : aovs()) all.push_back(aov_named(info.name));
  const std::stop_token stop = wanted();
  const std::lock_guard lock(mutex_);
  DeskFrame& held = frame_at(choice.frame);
  const std::string text = text_of(choice);
  if (numbers_of_ != text) {
    numbers_of_.clear();
    run(choice, all, false, numbers_, stop);
    numbers_of_ = text;
  }
  const Target& target = numbers_->target();
  const Rect window = target.color[0].window;
  if (x < 0 || y < 0 || x >= window.width() || y >= window.height()) {
    throw Error("pixel " + std::to_string(x) + ", " + std::to_string(y) + ": expected 0 ... " +
                std::to_string(window.width() - 1) + ", 0 ... " +
                std::to_string(window.height() - 1));
  }
  x += window.x0;
  y += window.y0;
  const auto at = [&](const auto& views) {
    return Rgb<float>{views[0].at(x, y), views[1].at(x, y), views[2].at(x, y)};
  };
  const CompositeJob job = job_for(held, choice);
  PixelNumbers numbers;
  numbers.dry = at(color_of(held.whole(kColorPlanes, scene_of(job, held.plate()))));
  numbers.picture = at(target.color);
  for (const Aov aov : all) {
    std::vector<float> values;
    for (const View<float>& view : target.of(aov)) {
      if (view) values.push_back(view.at(x, y));
    }
    numbers.aovs.emplace_back(aov, std::move(values));
  }
  return numbers;
}

Desk::Facts Desk::facts() {
  const DeskChoice start{options_.start, options_.settings};
  const std::lock_guard lock(mutex_);
  DeskFrame& held = frame_at({});
  const CompositeJob job = job_for(held, start);
  const Scene scene = scene_of(job, held.plate());
  const Plan plan = plan_of(job, held.plate(), scene);
  Facts facts;
  facts.window = held.whole(plan.planes, scene).work();
  facts.frame = frames_.front().number;
  facts.primaries = scene.primaries;
  facts.time = scene.time;
  facts.look = job.look;
  facts.warnings = warnings_of(job, held.plate(), plan);
  for (const auto& file : files_of(job.plate)) facts.files.push_back(file.filename().string());
  return facts;
}

}  // namespace limpid

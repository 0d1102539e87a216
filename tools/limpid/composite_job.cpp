#include "composite_job.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"

#include "frame_options.h"
#include "job/composite_view.h"
#include "memory_limit.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

/// Replaced by a view's name in names of files.
constexpr std::string_view kViewMark = "%V";
constexpr std::string_view kAllViews = "all";
/// Vectors are no plane of the chain, and are named as its planes are.
constexpr std::string_view kPrevious = "previous";
const std::string kMotion = "motion", kMotionReflected = "motion_reflected";

/// The layers of --pass-through: empty for none, which must be the only word.
std::vector<std::string> layers_to_pass(const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), "none") == names.end()) return names;
  if (names.size() == 1) return {};
  throw Error("--pass-through " + join(names, ",") + ": expected none alone, or names without it",
              Fault::kUsage);
}

double finite_nothing(double depth) {
  if (std::isfinite(depth)) return depth;
  throw Error("--depth-nothing " + std::to_string(depth) +
                  ": expected a finite number, since inf always means that no surface was hit",
              Fault::kUsage);
}

}  // namespace

LayerOverrides layer_overrides(const std::vector<std::string>& texts) {
  LayerOverrides overrides;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const bool whole = equals != std::string::npos && equals > 0 && equals + 1 < text.size();
    if (!whole || text.ends_with(':') || text[equals + 1] == ':') {
      throw Error("--layer " + text +
                      ": expected ROLE=LAYER, as in depth=ViewLayer.Depth.Z, depth=plate.exr:Z or "
                      "depth=none",
                  Fault::kUsage);
    }
    const std::string role = text.substr(0, equals);
    if (role != kMotion) as_usage([&] { role_named(role); });
    overrides[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return overrides;
}

namespace {

bool has_view_mark(const std::string& name) { return name.find(kViewMark) != std::string::npos; }

/// The name with each %V replaced by the view's name.
std::string name_of_view(std::string name, const std::string& view) {
  for (std::size_t at = name.find(kViewMark); at != std::string::npos; at = name.find(kViewMark)) {
    if (view.empty()) {
      throw Error(name + ": expected --view with the names that replace %V", Fault::kUsage);
    }
    name.replace(at, kViewMark.size(), view);
  }
  return name;
}

/// The files of a view on the command line, still with patterns for frame numbers.
CompositeJob::View inputs_of(const CompositeArguments& a, const std::string& view,
                             const std::optional<int>& frame, const Limits& limits) {
  CompositeJob::View inputs;
  inputs.name = view;
  inputs.plate.limits = limits;
  const std::string scene = name_of_view(a.scene, view);
  if (!scene.empty()) {
    inputs.scene = load_scene(frame ? name_of_frame(scene, *frame) : scene);
  }
  for (const std::string& file : a.plates) inputs.plate.files.push_back(name_of_view(file, view));
  inputs.plate.named = inputs.scene.plates;
  inputs.plate.layers = layer_overrides(a.layers);
  if (const auto motion = inputs.plate.layers.extract(kMotion))
    inputs.plate.motion = motion.mapped();
  // A view's own files need not contain its name.
  const bool own_files = std::any_of(a.plates.begin(), a.plates.end(), has_view_mark) ||
                         (a.plates.empty() && has_view_mark(a.scene));
  if (!own_files) inputs.plate.view = view;
  for (auto& [role, name] : inputs.plate.named) name = name_of_view(name, view);
  for (auto& [role, name] : inputs.plate.layers) name = name_of_view(name, view);
  return inputs;
}

/// The same for one frame.
void set_frame(const CompositeArguments& a, int frame, const std::string& view, PlateRequest& plate,
               SceneFile& scene) {
  const std::string file = name_of_view(a.scene, view);
  if (has_frame_number(file)) {
    scene = load_scene(name_of_frame(file, frame));
    plate.named = scene.plates;
    for (auto& [role, name] : plate.named) name = name_of_view(name, view);
  }
  for (auto& path : plate.files) path = name_of_frame(path.string(), frame);
  for (auto& [role, name] : plate.named) name = name_of_frame(name, frame);
  for (auto& [role, name] : plate.layers) name = name_of_frame(name, frame);
}

/// The views of --view; "" for the plate's first view.
std::vector<std::string> views_named(const CompositeArguments& a, const std::optional<int>& frame,
                                     const Limits& limits) {
  if (a.view != kAllViews) {
    std::vector<std::string> views;
    for (std::size_t at = 0; at <= a.view.size();) {
      const std::size_t end = std::min(a.view.find(',', at), a.view.size());
      views.push_back(a.view.substr(at, end - at));
      at = end + 1;
      if (views.back().empty() && !a.view.empty()) {
        throw Error("--view " + a.view + ": expected names between the commas", Fault::kUsage);
      }
    }
    return views;
  }
  CompositeArguments plates = a;
  if (has_view_mark(plates.scene)) plates.scene.clear();
  CompositeJob::View inputs = inputs_of(plates, "", frame, limits);
  if (frame) set_frame(plates, *frame, "", inputs.plate, inputs.scene);
  std::vector<std::string> views = Plate::views(inputs.plate);
  if (views.empty()) {
    throw Error("--view all: expected a plate with views, and no plate has any", Fault::kUsage);
  }
  return views;
}

/// The time of a frame whose own scene is `scene`.
JobTime time_of(const CompositeArguments& a, const SceneFile& scene, const std::string& view,
                int frame) {
  const bool scene_of_frame = has_frame_number(name_of_view(a.scene, view));
  return time_of_frame(a.frames, a.water, scene, scene_of_frame, frame);
}

/// The neighbor of a frame that its motion vectors lead to.
int neighbor_of(const CompositeArguments& a, int frame) {
  return a.motion_to == kPrevious ? frame - 1 : frame + 1;
}
CompositeJob::SecondFrame second_of(const CompositeArguments& a, int frame, const std::string& view,
                                    const PlateRequest& plate, const SceneFile& scene) {
  CompositeJob::SecondFrame second{plate, scene, {}, a.motion_to == kPrevious};
  try {
    set_frame(a, neighbor_of(a, frame), view, second.plate, second.scene);
    second.time = time_of(a, second.scene, view, neighbor_of(a, frame));
  } catch (const Error& error) {
    throw Error("the " + a.motion_to + " frame, for motion vectors: " + error.what(),
                error.fault());
  }
  return second;
}

/// Throws the usage Error for --motion-to without a second frame, or without vectors.
void expect_second(const CompositeArguments& a, bool frames, bool vectors) {
  if (a.motion_to.empty()) return;
  const auto refuse = [&](const std::string& expected) {
    throw Error("--motion-to " + a.motion_to + ": expected " + expected, Fault::kUsage);
  };
  if (!vectors) refuse("--aov motion or motion_reflected");
  const bool numbered =
      has_frame_number(a.scene) || std::any_of(a.plates.begin(), a.plates.end(), has_frame_number);
  if (!frames || !numbered) {
    refuse("--frames, and plates or a scene with the number of the frame in their names");
  }
  if (a.frames.missing != "error")
    refuse("--missing error, since motion vectors need the other frame");
}

}  // namespace

CompositeJob common_job(const CompositeArguments& a, const Sequence& sequence,
                        const CommonArguments& common) {
  CompositeJob job;
  const Limits limits = limits_of(common);
  const std::optional<int> frame =
      sequence.frames.empty() ? std::nullopt : std::optional(sequence.frames.front());
  for (const std::string& view : views_named(a, frame, limits)) {
    job.other_views.push_back(inputs_of(a, view, frame, limits));
  }
  job.view_name = job.other_views.front().name;
  job.plate = std::move(job.other_views.front().plate);
  job.scene = std::move(job.other_views.front().scene);
  job.other_views.erase(job.other_views.begin());
  if (a.plates.empty() && job.plate.named.empty() && job.plate.layers.empty()) {
    throw Error("nothing to put water into: expected plates, or a scene with [plates]",
                Fault::kUsage);
  }
  if (has_view_mark(a.water.output)) {
    throw Error("-o " + a.water.output +
                    ": expected a name without %V, since all views are written into one file",
                Fault::kUsage);
  }
  if (!a.depth_kind.empty()) job.depth_kind = depth_kind_named(a.depth_kind);
  if (!a.colorspace.empty()) {
    job.primaries = as_usage([&] { return color_space_named(a.colorspace); });
  }
  if (a.depth_nothing) job.depth_nothing = finite_nothing(*a.depth_nothing);
  job.look = look_of(a.water);
  job.time.explicit_time = a.water.time;
  WaterOptions water = a.water;
  const bool motion = std::erase(water.aovs, kMotion) > 0;
  const bool motion_reflected = std::erase(water.aovs, kMotionReflected) > 0;
  job.output = output_of(water);
  job.output.motion = motion;
  job.output.motion_reflected = motion_reflected;
  expect_second(a, frame.has_value(), motion || motion_reflected);
  job.output.wave_samples = a.samples;
  job.output.overscan = a.overscan;
  job.output.pass_through = layers_to_pass(a.pass_through);
  return job;
}

CompositeJob job_of_frame(CompositeJob job, const CompositeArguments& a, int frame) {
  const auto set = [&](const std::string& view, auto& inputs) {
    if (!a.motion_to.empty()) {
      inputs.second = second_of(a, frame, view, inputs.plate, inputs.scene);
    }
    set_frame(a, frame, view, inputs.plate, inputs.scene);
  };
  set(job.view_name, job);
  for (CompositeJob::View& view : job.other_views) set(view.name, view);
  job.time = time_of(a, job.scene, job.view_name, frame);
  job.output = output_of_frame(job.output, frame);
  return job;
}

void expect_second_frames(const CompositeArguments& a, const Sequence& sequence,
                          const JobOfFrame<CompositeJob>& job_of) {
  if (a.motion_to.empty()) return;
  const std::set<int> made(sequence.frames.begin(), sequence.frames.end());
  for (const int frame : sequence.frames) {
    if (made.contains(neighbor_of(a, frame))) continue;
    try {
      const CompositeJob job = job_of(frame);
      for (std::size_t view = 0; view <= job.other_views.size(); ++view) {
        plan_composite(job_of_view(job, view));
      }
    } catch (const Error& error) {
      throw Error("frame " + std::to_string(frame) + ": " + error.what(), error.fault());
    }
  }
}

void expect_one_view(const CompositeJob& job, const std::string& verb) {
  if (job.other_views.empty()) return;
  throw Error("--view: expected one view, since " + verb + " shows one at a time", Fault::kUsage);
}

}  // namespace limpid::tool

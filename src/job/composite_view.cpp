#include "job/composite_view.h"

#include <utility>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_camera.h"
#include "limpid/files/text/scene_file.h"

#include "core/toml_text.h"
#include "files/content_hash.h"
#include "job/parallax.h"
#include "job/pass_through.h"
#include "job/picture_warnings.h"
#include "plate/primaries.h"

namespace limpid {
namespace {

/// The name of the picture's part beside other parts, if the plate has no name for it.
constexpr const char* kPicturePart = "rgba";

/// What a record has where vectors are not alone those of what is seen through the water.
std::string reflected_text(const OutputChoice& choice) {
  if (!choice.motion_reflected) return "";
  return line("motion_of", choice.motion ? "[\"seen\", \"reflected\"]" : "[\"reflected\"]");
}

/// The vectors to a second frame, as Nuke calls them.
MotionLayer second_layer(const CompositeJob& job) {
  return {job.second->is_previous ? "motion_backward" : "motion_forward", {"u", "v"}, {}};
}

std::string no_normals(const CompositeJob& job) {
  return std::string("the ") + (job.second->is_previous ? "previous" : "next") +
         " frame has no normals of the surface: its water counts as calm for motion vectors";
}

}  // namespace

CompositeJob job_of_view(const CompositeJob& job, std::size_t view) {
  CompositeJob one = job;
  if (view > 0) {
    one.view_name = job.other_views[view - 1].name;
    one.plate = job.other_views[view - 1].plate;
    one.scene = job.other_views[view - 1].scene;
    one.second = job.other_views[view - 1].second;
  }
  one.other_views.clear();
  return one;
}

PreparedView prepare_view(const CompositeJob& job) {
  Plate plate = Plate::open(job.plate);
  Scene scene = scene_of(job, plate);
  const DepthMeaning depth = depth_of(job);
  Plan plan = plan_of(job, plate, scene);
  TextureFiles textures = textures_read(plan, job.scene);
  std::vector<PassedPart> passed = plate.passed(job.output.pass_through);
  std::vector<MotionLayer> motion;
  std::optional<PreparedSecond> second;
  if (has_motion(job.output) && job.second) {
    second = prepare_second(job, plate, scene, plan);
    motion = {second_layer(job)};
  } else if (has_motion(job.output)) {
    motion = plate.motion_layers();
  }
  expect_passable(passed, motion, job.output);
  return {job.view_name,    std::move(plate),    std::move(scene),  depth,
          std::move(plan),  std::move(textures), std::move(passed), std::move(motion),
          std::move(second)};
}

Record record_of(const CompositeJob& job, const PreparedView& view, SharedTextures& textures,
                 const std::string& gpu) {
  const DepthMeaning& depth = view.depth;
  std::string inputs = "depth_kind = \"" + std::string(depth_kind_name(depth.kind)) + "\"\n";
  if (depth.kind == DepthKind::kNormalised) {
    inputs += "near = " + toml_text(depth.near) + "\nfar = " + toml_text(depth.far) + "\n";
  }
  if (depth.nothing) inputs += "depth_nothing = " + toml_text(*depth.nothing) + "\n";
  inputs += view.plate.inputs_text(view.plan.planes) + texture_inputs(view.textures, textures);
  const std::string options =
      picture_options(job.output, gpu) + view.plate.passed_text(view.passed) +
      (view.second
           ? line("motion_to",
                  toml_text(hash_of(to_toml(view.second->scene) + view.second->inputs_text())))
           : view.plate.motion_text(view.motion)) +
      reflected_text(job.output);
  Record record = record_of(view.scene, inputs, options);
  add_look(record, job.look, view.plan);
  return record;
}

void CompositeView::read(const CompositeJob& job, PreparedView view, SharedTextures& textures,
                         CompositeReport& report) {
  const Plate& plate = view.plate;
  scene_ = std::move(view.scene);
  report.plan = std::move(view.plan);
  plate.read(report.plan.planes, scene_, view.depth, loaded_);
  loaded_.frame.overscan = job.output.overscan;
  textures_ = textures.load(view.textures, job.plate.limits);
  textures_.show_in(loaded_.frame);
  report.size = loaded_.frame.work().size();
  report.replaced = loaded_.replaced;
  off_frame_ = off_frame_lookups_of(report.plan, loaded_.frame, scene_);
  report.warnings = warnings_of(job, plate, report.plan);
  warn_of_pixels(job, report.plan, loaded_.frame, scene_, loaded_.transparent, report.warnings);
  warn_of_off_frame(off_frame_, report.warnings);
  if (view.second && view.second->lacks_normals) report.warnings.push_back(no_normals(job));
  for (std::string& warning : manifest_warnings(view.passed, job.output)) {
    report.warnings.push_back(std::move(warning));
  }
  refuse_warnings(job.output.strict, report.warnings);
  if (job.output.pass_through.empty()) report.left_out = plate.other_layers();

  file_ = {};
  file_.data = loaded_.frame.work();
  file_.display = plate.display();
  file_.pixel_aspect = plate.pixel_aspect();
  file_.inherited = plate.attributes();
  tell_primaries(file_.inherited, scene_.primaries);
  file_.matrices = camera_attributes(*scene_.camera);
  file_.compression = job.output.compression;
  file_.name = plate.part_name().empty() ? kPicturePart : plate.part_name();
  motion_ = {};
  if (view.second) {
    if (!second_) second_.emplace();
    second_->read(std::move(*view.second));
    motion_.expect_second(std::move(view.motion));
  } else {
    second_.reset();
    if (has_motion(job.output)) motion_.read(plate, std::move(view.motion));
  }
  others_ = pass_through(view.passed, file_);
  plate_ = std::move(view.plate);
}

void CompositeView::run(const CompositeJob& job, const Plan& plan, Executor& executor,
                        RunTimes* times) {
  canvas_for(canvas_, loaded_.frame.work(), job.output)
      .paint(plan, loaded_.frame, scene_, job.output, executor, times);
  if (has_motion(job.output)) run_motion(job.output, plan, executor);
}

void CompositeView::run_motion(const OutputChoice& choice, const Plan& plan, Executor& executor) {
  const Target& target = canvas_->target();
  const Frame& frame = loaded_.frame;
  const View<float>& surface = target.of(Aov::kSurfaceDepth)[0];
  const WaterView view(scene_, frame.display);
  std::optional<WaterView> second_view;
  std::optional<Parallax> parallax;
  if (second_) {
    second_view.emplace(second_->scene(), frame.display);
    std::optional<Parallax::Waves> waves;
    if (second_->has_waves(plan)) {
      const auto& normal = target.of(Aov::kNormal);
      waves = {{surface, normal[0], normal[1], normal[2]},
               second_->paint(textures_, frame.display, choice, executor)};
    }
    parallax.emplace(view, *second_view, plan.look.water.ior, waves);
  }
  if (choice.motion) {
    const auto& map = target.of(Aov::kStmapG);
    const LookedUp looked_up{map[0], map[1], surface, frame.display};
    if (parallax) {
      motion_.carry(*parallax, looked_up, frame.plane(PlaneId::kDepth), frame.work(), executor);
    } else {
      motion_.carry(looked_up, frame.work());
    }
  }
  if (choice.motion_reflected) {
    const auto& normal = target.of(Aov::kNormal);
    const Mirrored mirrored{surface,
                            normal[0],
                            normal[1],
                            normal[2],
                            target.of(Aov::kReflectionDepth)[0],
                            frame.plane(PlaneId::kDepth),
                            view};
    if (parallax) {
      motion_.reflect(*parallax, mirrored, frame.work(), executor);
    } else {
      motion_.reflect(mirrored, frame.work());
    }
  }
  file_.channels = motion_.channels(choice);
}

WrittenView CompositeView::written(Record record) {
  file_.text = std::move(record);
  return {&*canvas_, file_, others_, {}, scene_.primaries};
}

void CompositeView::forget() {
  file_ = {};
  others_.clear();
  plate_.reset();
}

}  // namespace limpid

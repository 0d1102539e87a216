#include "job/composite_view.h"

#include <utility>

#include "limpid/files/exr/exr_camera.h"

#include "core/toml_text.h"
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

}  // namespace

CompositeJob job_of_view(const CompositeJob& job, std::size_t view) {
  CompositeJob one = job;
  if (view > 0) {
    one.view_name = job.other_views[view - 1].name;
    one.plate = job.other_views[view - 1].plate;
    one.scene = job.other_views[view - 1].scene;
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
  if (has_motion(job.output)) motion = plate.motion_layers();
  expect_passable(passed, motion, job.output);
  return {job.view_name,   std::move(plate),    std::move(scene),  depth,
          std::move(plan), std::move(textures), std::move(passed), std::move(motion)};
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
  const std::string options = picture_options(job.output, gpu) +
                              view.plate.passed_text(view.passed) +
                              view.plate.motion_text(view.motion) + reflected_text(job.output);
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
  beyond_ = beyond_of(report.plan, loaded_.frame, scene_);
  report.warnings = warnings_of(job, plate, report.plan);
  warn_of_pixels(report.plan, loaded_.frame, scene_, loaded_.transparent, report.warnings);
  warn_of_beyond(beyond_, report.warnings);
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
  if (has_motion(job.output)) motion_.read(plate, std::move(view.motion));
  others_ = pass_through(view.passed, file_);
  plate_ = std::move(view.plate);
}

void CompositeView::run(const CompositeJob& job, const Plan& plan, Executor& executor,
                        RunTimes* times) {
  canvas_for(canvas_, loaded_.frame.work(), job.output)
      .paint(plan, loaded_.frame, scene_, job.output, executor, times);
  if (!has_motion(job.output)) return;
  const Target& target = canvas_->target();
  const View<float>& surface = target.of(Aov::kSurfaceDepth)[0];
  if (job.output.motion) {
    const auto& map = target.of(Aov::kStmapG);
    motion_.carry({map[0], map[1], surface, loaded_.frame.display}, loaded_.frame.work());
  }
  if (job.output.motion_reflected) {
    const auto& normal = target.of(Aov::kNormal);
    const WaterView view(scene_, loaded_.frame.display);
    motion_.reflect({surface, normal[0], normal[1], normal[2], target.of(Aov::kReflectionDepth)[0],
                     loaded_.frame.plane(PlaneId::kDepth), view},
                    loaded_.frame.work());
  }
  file_.channels = motion_.channels(job.output);
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

#include "limpid/job/water.h"

#include <algorithm>
#include <iterator>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_camera.h"
#include "limpid/job/job_files.h"

#include "job/picture_warnings.h"
#include "job/stopwatch.h"
#include "job/water_frame.h"

namespace limpid {
namespace {

Scene scene_of(const Model& model, const RenderJob& job) {
  Scene scene = job.scene.scene;
  const Size size = job.render.size;
  if (job.scene.camera) scene.camera = camera_for(*job.scene.camera, size);
  scene.time = job.time;
  return scene_of_model(scene, model, size);
}

Plan plan_of(const Model& model, const Scene& scene, const WaterJob& job) {
  return make_plan(job.look,
                   {.planes = renderable(model, scene),
                    .wave_map = !job.look.of<WaveNormals>().map.empty(),
                    .sun = scene.sun.has_value(),
                    .environment = has_environment(job.render.scene),
                    .waves = scene.has_waves()},
                   state_shown_by(computed_aovs(job.output)), job.output.max_error);
}

struct NamedPlane {
  PlaneId plane;
  const char* channel;
};
constexpr NamedPlane kPlaneChannels[] = {
    {PlaneId::kColorR, "color.R"},
    {PlaneId::kColorG, "color.G"},
    {PlaneId::kColorB, "color.B"},
    {PlaneId::kColorA, "color.A"},
    {PlaneId::kDepth, "depth.Z"},
    {PlaneId::kShadow, "shadow.Y"},
    {PlaneId::kReflectionR, "reflection.R"},
    {PlaneId::kReflectionG, "reflection.G"},
    {PlaneId::kReflectionB, "reflection.B"},
    {PlaneId::kSurfaceDepth, "surface.Z"},
    {PlaneId::kSurfaceNormalX, "surface.NX"},
    {PlaneId::kSurfaceNormalY, "surface.NY"},
    {PlaneId::kSurfaceNormalZ, "surface.NZ"},
    {PlaneId::kReflectionValid, "reflection.A"},
    {PlaneId::kReflectionDepth, "reflection.Z"},
    {PlaneId::kBelowR, "below.R"},
    {PlaneId::kBelowG, "below.G"},
    {PlaneId::kBelowB, "below.B"},
    {PlaneId::kBelowDepth, "below.Z"},
    {PlaneId::kSurfaceShadow, "surface_shadow.Y"},
    {PlaneId::kSkyR, "sky.R"},
    {PlaneId::kSkyG, "sky.G"},
    {PlaneId::kSkyB, "sky.B"},
    {PlaneId::kAlbedoR, "albedo.R"},
    {PlaneId::kAlbedoG, "albedo.G"},
    {PlaneId::kAlbedoB, "albedo.B"},
};
static_assert(std::size(kPlaneChannels) == kPlaneCount);

void check(const WaterJob& job) {
  if (job.samples < 1 || job.samples > kMostSamples) {
    throw Error("samples = " + std::to_string(job.samples) + ": expected 1 ... " +
                    std::to_string(kMostSamples),
                Fault::kUsage);
  }
  if (job.samples > 1 && !job.output.deep.empty()) {
    throw Error("samples = " + std::to_string(job.samples) + " and a deep file: expected 1, " +
                    "for depths of several samples have no mean",
                Fault::kUsage);
  }
  const Size size = job.render.render.size;
  const int most = kMostRenderedSide / job.samples;
  if (std::max({size.width, size.height, job.render.render.overscan}) > most) {
    throw Error("size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                    ", overscan " + std::to_string(job.render.render.overscan) + ", samples " +
                    std::to_string(job.samples) + ": expected at most " + std::to_string(most) +
                    " pixels a side",
                Fault::kUsage);
  }
}

Record record_of(const HashedModel& model, const PlateJob& job, const Scene& scene) {
  return record_of(scene, model_inputs(model, job.render.render),
                   raster_options(job.render.render.simd) +
                       file_options(job.output.compression, job.output.store_float));
}

Record record_of(const HashedModel& model, const WaterJob& job, const Scene& scene,
                 const Plan& plan, SharedTextures& textures) {
  const std::string inputs = model_inputs(model, job.render.render) +
                             "samples = " + std::to_string(job.samples) + "\n" +
                             texture_inputs(plan, job.render.scene, textures);
  Record record = record_of(scene, inputs,
                            raster_options(job.render.render.simd) + picture_options(job.output));
  add_look(record, job.look, plan);
  return record;
}

}  // namespace

Record record_of(const HashedModel& model, const PlateJob& job) {
  return record_of(model, job, scene_of(*model.model, job.render));
}

Record record_of(const HashedModel& model, const WaterJob& job, SharedTextures& textures) {
  check(job);
  const Scene scene = scene_of(*model.model, job.render);
  return record_of(model, job, scene, plan_of(*model.model, scene, job), textures);
}

void render(const Model& model, const PlateJob& job, Executor& executor) {
  const HashedModel hashed(model);
  RenderFrame frame(hashed);
  frame.read(job, executor);
  frame.write(job);
}

void RenderFrame::read(const PlateJob& job, Executor& executor) {
  Stopwatch watch;
  const Model& model = *model_->model;
  expect_apart(files_of(model, job));
  scene_ = scene_of(model, job.render);
  expect_writable(job.output.plate);
  record_ = record_of(*model_, job, scene_);
  plate_ = {};  // before another is made
  plate_ = render_plate(model, scene_, job.render.render, renderable(model, scene_), executor);
  report_.size = job.render.render.size;
  report_.read_seconds = watch.lap();
}

void RenderFrame::write(const PlateJob& job) {
  Stopwatch watch;
  ExrOutput file;
  file.data = plate_.planes[0].view().window;
  file.display = plate_.frame.display;
  file.compression = job.output.compression;
  file.matrices = camera_attributes(*scene_.camera);
  file.text = record_;
  const auto add = [&](const std::string& name, const Plane& plane) {
    if (plane)
      file.channels.push_back(
          {name, plane.view(), !job.output.store_float && !name.ends_with(".Z")});
  };
  for (const NamedPlane& named : kPlaneChannels) {
    add(named.channel, plate_.planes[static_cast<std::size_t>(index_of(named.plane))]);
  }
  write_exr(job.output.plate, file);
  report_.write_seconds = watch.lap();
}

Plan plan_water(const Model& model, const WaterJob& job) {
  return plan_of(model, scene_of(model, job.render), job);
}

CompositeReport water(const Model& model, const WaterJob& job, Executor& executor) {
  SharedTextures textures;
  const HashedModel hashed(model);
  WaterFrame frame(hashed, textures);
  frame.read(job, executor);
  frame.run(job, executor);
  frame.write(job);
  return frame.report();
}

void WaterFrame::read(const WaterJob& job, Executor& executor) {
  Stopwatch watch;
  check(job);
  const Model& model = *model_->model;
  expect_apart(files_of(model, job));
  expect_writable(job.output);
  scene_ = scene_of(model, job.render);
  report_ = {};
  report_.plan = plan_of(model, scene_, job);
  record_ = record_of(*model_, job, scene_, report_.plan, *textures_);
  RenderOptions options = job.render.render;
  options.size = {options.size.width * job.samples, options.size.height * job.samples};
  options.overscan *= job.samples;
  plate_ = {};  // before another is made
  plate_ = render_plate(model, scene_, options, report_.plan.planes, executor);
  report_.replaced = sanitise_planes(plate_.planes, scene_.water->up);
  wave_map_ = textures_->wave_map(report_.plan, job.render.limits);
  environment_ = textures_->environment(report_.plan, job.render.scene, job.render.limits);
  plate_.frame.wave_map = texture_of(wave_map_);
  plate_.frame.environment = texture_of(environment_);
  report_.size = job.render.render.size;
  report_.warnings = report_.plan.warnings;
  warn_of_picture(report_.plan, plate_.frame, scene_, report_.warnings);
  refuse_warnings(job.output.strict, report_.warnings);
  report_.read_seconds = watch.lap();
}

void WaterFrame::run(const WaterJob& job, Executor& executor) {
  Stopwatch watch;
  canvas_for(canvas_, plate_.frame.work(), job.output)
      .paint(report_.plan, plate_.frame, scene_, job.output, executor);
  report_.run_seconds = watch.lap();
}

void WaterFrame::write(const WaterJob& job) {
  Stopwatch watch;
  ExrOutput file;
  file.display = rect_of(report_.size);
  file.matrices = camera_attributes(*scene_.camera);
  file.text = record_;
  if (job.samples > 1) {
    canvas_->filtered(job.samples, job.output).write(file, job.output);
  } else {
    canvas_->write(file, job.output);
  }
  report_.write_seconds = watch.lap();
}

}  // namespace limpid

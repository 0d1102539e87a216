#include "limpid/composite.h"

#include <cmath>

#include "limpid/core/error.h"
#include "limpid/write/exr_camera.h"

#include "canvas.h"
#include "stopwatch.h"

namespace limpid {
namespace {

/// The job's scene, completed by what only the plate knows: size, pixel aspect, a camera in its
/// attributes, or a whole scene, as limpid render leaves it. No chain can do without camera and
/// water plane.
Scene scene_of(const CompositeJob& job, const Plate& plate) {
  const SceneFile carried = plate.scene();
  Scene scene = job.scene.scene;
  if (!scene.water) scene.water = carried.scene.water;
  if (!scene.sun) scene.sun = carried.scene.sun;
  const auto& lens = job.scene.camera ? job.scene.camera : carried.camera;
  scene.camera =
      lens ? camera_for(*lens, plate.display().size(), plate.pixel_aspect()) : plate.camera();
  if (!scene.camera) {
    throw Error(
        "no camera found: expected a scene with [camera] view and projection (or fov_x, fov_y, "
        "orthographic), or a plate with the attributes worldToCamera and worldToNDC");
  }
  if (!scene.water) {
    throw Error("no water plane found: expected a scene with [water] up and height");
  }
  scene.time = job.time.value_or(carried.scene.time);
  return scene;
}

/// What the depth planes hold. A near and far that were made up, as those of a bare field of view,
/// would give wrong distances.
DepthMeaning depth_of(const CompositeJob& job) {
  const SceneFile& scene = job.scene;
  const DepthKind kind = job.depth_kind.value_or(scene.depth);
  const bool both = scene.near && scene.far;
  if (kind == DepthKind::kNormalised && !(both && std::isfinite(*scene.far))) {
    throw Error("depth of kind normalised: expected near and a finite far in the scene's [camera]");
  }
  const bool known = scene.camera && (scene.camera->lens == CameraSpec::Lens::kProjection || both);
  if (kind == DepthKind::kDevice && !known) {
    throw Error(
        "depth of kind device: expected a projection, or near and far beside the lens, in the "
        "scene's [camera]");
  }
  return {kind, scene.near.value_or(0), scene.far.value_or(0)};
}

Plan plan_of(const CompositeJob& job, const Plate& plate, const Scene& scene) {
  if (!plate.planes().has(PlaneId::kDepth)) plate.refuse_without("depth");
  return make_plan(job.look,
                   {.planes = plate.planes(),
                    .wave_map = !job.look.of<WaveNormals>().map.empty(),
                    .sun = scene.sun.has_value(),
                    .environment = has_environment(job.scene)},
                   state_shown_by(computed_aovs(job.output)), job.output.max_error);
}

/// What a survey looks at: depths, colors and shadows; not where the water's normals point, nor
/// what it mirrors.
constexpr PlaneSet kUnsurveyed = kSurfaceNormalPlanes | kReflectionPlanes |
                                 PlaneSet{PlaneId::kReflectionValid, PlaneId::kReflectionDepth};

}  // namespace

Plan plan_composite(const CompositeJob& job) {
  const Plate plate = Plate::open(job.plate);
  depth_of(job);
  return plan_of(job, plate, scene_of(job, plate));
}

SurveyedPlan survey_composite(const CompositeJob& job, Executor& executor) {
  const Plate plate = Plate::open(job.plate);
  const Scene scene = scene_of(job, plate);
  SurveyedPlan surveyed{plan_of(job, plate, scene), {}};
  const Plan& plan = surveyed.plan;
  const LoadedPlate loaded = plate.read(plan.planes - kUnsurveyed, scene, depth_of(job));
  loaded.frame.validate();
  const Context context(scene, loaded.frame, plan.look.water.ior, plan.made);
  surveyed.survey.make(plan, loaded.frame, context, executor, job.output.simd);
  return surveyed;
}

CompositeReport composite(const CompositeJob& job, Executor& executor) {
  Stopwatch watch;
  const Plate plate = Plate::open(job.plate);
  const Scene scene = scene_of(job, plate);
  const DepthMeaning depth = depth_of(job);
  CompositeReport report;
  report.plan = plan_of(job, plate, scene);
  expect_writable(job.output);

  LoadedPlate loaded = plate.read(report.plan.planes, scene, depth);
  const LoadedTexture map = wave_map_of(report.plan, job.plate.limits);
  loaded.frame.wave_map = map.texture;
  const LoadedTexture environment = environment_of(report.plan, job.scene, job.plate.limits);
  loaded.frame.environment = environment.texture;
  report.size = loaded.frame.work().size();
  report.replaced = loaded.replaced;
  report.read_seconds = watch.lap();

  Canvas canvas(loaded.frame.work(), job.output);
  canvas.paint(report.plan, loaded.frame, scene, job.output, executor);
  report.run_seconds = watch.lap();

  ExrOutput file;
  file.display = plate.display();
  file.pixel_aspect = plate.pixel_aspect();
  file.inherited = plate.attributes();
  file.matrices = camera_attributes(*scene.camera);
  file.text = {{"limpid/scene", to_toml(scene)}};
  canvas.write(file, report.plan, job.look, job.output);
  report.write_seconds = watch.lap();
  return report;
}

}  // namespace limpid

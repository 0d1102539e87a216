#include "limpid/composite.h"

#include <chrono>
#include <cmath>
#include <map>

#include "limpid/core/error.h"
#include "limpid/run/fused.h"
#include "limpid/run/reference.h"
#include "limpid/version.h"
#include "limpid/write/exr_writer.h"
#include "limpid/write/preview.h"

namespace limpid {
namespace {

/// The job's scene, completed by what only the plate knows: size, pixel aspect, a camera in its
/// attributes. No chain can do without camera and water plane.
Scene scene_of(const CompositeJob& job, const Plate& plate) {
  Scene scene = job.scene.scene;
  scene.camera = job.scene.camera
                     ? camera_for(*job.scene.camera, plate.display().size(), plate.pixel_aspect())
                     : plate.camera();
  if (!scene.camera) {
    throw Error(
        "no camera found: expected a scene with [camera] view and projection (or fov_x, fov_y, "
        "orthographic), or a plate with the attributes worldToCamera and worldToNDC");
  }
  if (!scene.water) {
    throw Error("no water plane found: expected a scene with [water] up and height");
  }
  scene.time = job.time;
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
  StateSet shown;
  for (Aov aov : job.aovs) shown = shown | StateSet{aovs()[static_cast<std::size_t>(aov)].part};
  return make_plan(job.look,
                   {.planes = plate.planes(),
                    .wave_map = !job.look.of<WaveNormals>().map.empty(),
                    .sun = scene.sun.has_value()},
                   shown);
}

/// The picture and the wanted AOVs in memory, with their names in the file.
struct Canvas {
  Canvas(Rect window, const CompositeJob& job) {
    for (int i = 0; i < 3; ++i) target.color[i] = add(window, std::string(1, "RGB"[i]), job);
    target.alpha = add(window, "A", job);
    for (Aov aov : job.aovs) {
      const AovInfo& info = aovs()[static_cast<std::size_t>(aov)];
      for (std::size_t i = 0; i < info.suffixes.size(); ++i) {
        const std::string name = std::string(info.name) + "." + info.suffixes[i];
        target.of(aov)[i] = add(window, name, job);
      }
    }
  }

  Target target;
  std::vector<ExrOutputChannel> channels;

 private:
  View<float> add(Rect window, const std::string& name, const CompositeJob& job) {
    planes_.emplace_back(window);
    const bool depth = name.ends_with(".Z") && !name.starts_with("normal");
    channels.push_back({name, planes_.back().view(), !job.store_float && !depth});
    return planes_.back().view();
  }
  std::vector<Plane> planes_;
};

void write(const CompositeJob& job, const Plate& plate, const Plan& plan, const Canvas& canvas) {
  ExrOutput output;
  output.data = canvas.target.color[0].window;
  output.display = plate.display();
  output.pixel_aspect = plate.pixel_aspect();
  output.compression = job.compression;
  output.channels = canvas.channels;
  output.inherited = plate.attributes();
  output.text = {{"limpid/version", kVersion},
                 {"limpid/look", to_toml(plan.look)},
                 {"limpid/plan", to_text(plan)}};
  // The picture comes last: when anything fails, what was under its name before is still there.
  if (!job.preview.empty()) {
    const auto& c = canvas.target.color;
    write_preview(job.preview, c[0], c[1], c[2]);
  }
  write_exr(job.output, output);
}

class Stopwatch {
 public:
  /// Seconds since the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

Plan plan_composite(const CompositeJob& job) {
  const Plate plate = Plate::open(job.plate);
  depth_of(job);
  return plan_of(job, plate, scene_of(job, plate));
}

CompositeReport composite(const CompositeJob& job, Executor& executor) {
  Stopwatch watch;
  const Plate plate = Plate::open(job.plate);
  const Scene scene = scene_of(job, plate);
  const DepthMeaning depth = depth_of(job);
  CompositeReport report;
  report.plan = plan_of(job, plate, scene);

  LoadedPlate loaded = plate.read(report.plan.planes, scene, depth);
  LoadedTexture map;
  if (report.plan.reads_wave_map) {
    map = load_texture(job.look.of<WaveNormals>().map, job.plate.limits);
    loaded.frame.wave_map = map.texture;
  }
  report.size = loaded.frame.work().size();
  report.replaced = loaded.replaced;
  report.read_seconds = watch.lap();

  const Canvas canvas(loaded.frame.work(), job);
  if (job.runner == Runner::kReference) {
    run_reference(report.plan, loaded.frame, scene, canvas.target);
  } else {
    run_fused(report.plan, loaded.frame, scene, canvas.target, executor, {.simd = job.simd});
  }
  report.run_seconds = watch.lap();

  write(job, plate, report.plan, canvas);
  report.write_seconds = watch.lap();
  return report;
}

}  // namespace limpid

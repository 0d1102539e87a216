#include "limpid/water.h"

#include <algorithm>
#include <iterator>

#include "limpid/core/error.h"
#include "limpid/raster/mirror.h"
#include "limpid/version.h"
#include "limpid/write/exr_camera.h"

#include "canvas.h"
#include "stopwatch.h"

namespace limpid {
namespace {

Scene scene_of(const Model& model, const RenderJob& job) {
  Scene scene = job.scene.scene;
  const Size size = job.render.size;
  if (job.scene.camera) scene.camera = camera_for(*job.scene.camera, size);
  scene.time = job.time;
  return scene_of_model(scene, model, size);
}

/// What can be rendered of this model in this scene.
PlaneSet renderable(const Model& model, const Scene& scene) {
  if (!scene.water)
    throw Error("no water plane found: expected a scene with [water] up and height");
  PlaneSet planes = kColorPlanes | kBelowPlanes | PlaneSet{PlaneId::kColorA, PlaneId::kDepth};
  if (scene.sun) planes = planes | PlaneSet{PlaneId::kShadow, PlaneId::kSurfaceShadow};
  if (scene.camera && sees_mirror(*scene.camera, *scene.water)) {
    planes =
        planes | kReflectionPlanes | PlaneSet{PlaneId::kReflectionValid, PlaneId::kReflectionDepth};
  }
  const bool water = std::any_of(model.instances.begin(), model.instances.end(),
                                 [](const Instance& i) { return i.water; });
  if (water) planes = planes | PlaneSet{PlaneId::kSurfaceDepth};
  if (!water && !scene.water->waves.empty()) {
    throw Error("water.waves move a mesh, and the geometry has none whose node says water = true");
  }
  // A calm mesh has nothing to say that the plane does not; its normals would only keep others out.
  if (water && !scene.water->waves.empty()) planes = planes | kSurfaceNormalPlanes;
  return planes;
}

Plan plan_of(const Model& model, const Scene& scene, const WaterJob& job) {
  return make_plan(job.look,
                   {.planes = renderable(model, scene),
                    .wave_map = !job.look.of<WaveNormals>().map.empty(),
                    .sun = scene.sun.has_value(),
                    .environment = has_environment(job.render.scene)},
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
};
static_assert(std::size(kPlaneChannels) == kPlaneCount);

}  // namespace

void render(const Model& model, const RenderJob& job, const PlateOutput& output,
            Executor& executor) {
  const Scene scene = scene_of(model, job);
  const RenderedPlate plate =
      render_plate(model, scene, job.render, renderable(model, scene), executor);
  ExrOutput file;
  file.data = plate.planes[0].view().window;
  file.display = plate.frame.display;
  file.compression = output.compression;
  file.matrices = camera_attributes(*scene.camera);
  file.text = {{"limpid/version", kVersion}, {"limpid/scene", to_toml(scene)}};
  const auto add = [&](const std::string& name, const Plane& plane) {
    if (plane)
      file.channels.push_back({name, plane.view(), !output.store_float && !name.ends_with(".Z")});
  };
  for (const NamedPlane& named : kPlaneChannels) {
    add(named.channel, plate.planes[static_cast<std::size_t>(index_of(named.plane))]);
  }
  write_exr(output.plate, file);
}

Plan plan_water(const Model& model, const WaterJob& job) {
  return plan_of(model, scene_of(model, job.render), job);
}

CompositeReport water(const Model& model, const WaterJob& job, Executor& executor) {
  if (job.samples < 1 || job.samples > 16) {
    throw Error("samples = " + std::to_string(job.samples) + ": expected 1 ... 16");
  }
  if (job.samples > 1 && !job.output.deep.empty()) {
    throw Error("samples = " + std::to_string(job.samples) + " and a deep file: expected 1, " +
                    "for depths of several samples have no mean",
                Fault::kUsage);
  }
  const Size size = job.render.render.size;
  const int most = 32000 / job.samples;
  if (std::max({size.width, size.height, job.render.render.overscan}) > most) {
    throw Error("size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                ", overscan " + std::to_string(job.render.render.overscan) + ", samples " +
                std::to_string(job.samples) + ": expected at most " + std::to_string(most) +
                " pixels a side");
  }
  expect_writable(job.output);
  Stopwatch watch;
  const Scene scene = scene_of(model, job.render);
  CompositeReport report;
  report.plan = plan_of(model, scene, job);
  RenderOptions options = job.render.render;
  options.size = {options.size.width * job.samples, options.size.height * job.samples};
  options.overscan *= job.samples;
  RenderedPlate plate = render_plate(model, scene, options, report.plan.planes, executor);
  report.replaced = sanitise_planes(plate.planes, scene.water->up);
  const LoadedTexture map = wave_map_of(report.plan);
  plate.frame.wave_map = map.texture;
  const LoadedTexture environment = environment_of(report.plan, job.render.scene);
  plate.frame.environment = environment.texture;
  report.size = job.render.render.size;
  report.read_seconds = watch.lap();

  Canvas canvas(plate.frame.work(), job.output);
  canvas.paint(report.plan, plate.frame, scene, job.output, executor);
  report.run_seconds = watch.lap();

  ExrOutput file;
  file.display = rect_of(report.size);
  file.matrices = camera_attributes(*scene.camera);
  file.text = {{"limpid/scene", to_toml(scene)}};
  if (job.samples > 1) {
    canvas.filtered(job.samples, job.output).write(file, report.plan, job.look, job.output);
  } else {
    canvas.write(file, report.plan, job.look, job.output);
  }
  report.write_seconds = watch.lap();
  return report;
}

}  // namespace limpid

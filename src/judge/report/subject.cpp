#include "judge/report/subject.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/enter/sanitise.h"
#include "limpid/files/gltf/gltf.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/plate/plate.h"
#include "limpid/raster/render_plate.h"

namespace limpid {
namespace {

Plane every_nth(const Plane& plane, int n) {
  const View<const float> from = plane.view();
  const Rect& w = from.window;
  const auto up = [n](int at) { return at > 0 ? (at + n - 1) / n : at / n; };
  Plane thin({up(w.x0), up(w.y0), w.x1 / n, w.y1 / n});
  const View<float> to = thin.view();
  for (int y = to.window.y0; y < to.window.y1; ++y) {
    for (int x = to.window.x0; x < to.window.x1; ++x) {
      to.at(x, y) = from.at(x * n + (n - 1) / 2, y * n + (n - 1) / 2);
    }
  }
  return thin;
}

int thinning(Size plate, Size scenes) {
  int n = std::min(plate.width / (2 * scenes.width), plate.height / (2 * scenes.height));
  while (n > 1 && (plate.width % n != 0 || plate.height % n != 0)) --n;
  return std::max(n, 1);
}

/// `planes` by PlaneId.
void thin(Frame& frame, std::vector<Plane>& planes, int n) {
  frame.display = rect_of({frame.display.width() / n, frame.display.height() / n});
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!planes[i]) continue;
    planes[i] = every_nth(planes[i], n);
    frame.planes[i] = planes[i].view();
  }
}

}  // namespace

Subject Subject::of_plate(const std::filesystem::path& scene_file, Size size) {
  const SceneFile file = load_scene(scene_file);
  if (!file.camera) throw Error(scene_file.string() + ": expected a [camera] with a view");
  PlateRequest request;
  request.named = file.plates;
  const Plate plate = Plate::open(request);

  Subject subject;
  subject.scene_ = file.scene;
  subject.scene_.camera = camera_for(*file.camera, plate.display().size(), plate.pixel_aspect());
  subject.scene_.time = kMoment;
  const DepthMeaning depth{file.depth, file.near.value_or(0), file.far.value_or(0)};
  LoadedPlate loaded = plate.read(plate.planes(), subject.scene_, depth);
  subject.frame_ = loaded.frame;
  subject.planes_ = std::move(loaded.planes);
  thin(subject.frame_, subject.planes_, thinning(plate.display().size(), size));
  if (!file.environment.empty()) {
    subject.environment_ = load_environment(file.environment, file.environment_rotation);
  }
  subject.describe(scene_file, "plate");
  return subject;
}

Subject Subject::of_scene(const std::filesystem::path& scene_file, Size size,
                          const std::filesystem::path& sky, Executor& executor, double time) {
  return of_model(scene_file, load_gltf(load_scene(scene_file).geometry), size, sky, executor,
                  time);
}

Scene Subject::scene_of(const SceneFile& file, const Model& model, Size size) {
  Scene scene = file.scene;
  if (file.camera) scene.camera = camera_for(*file.camera, size);
  return scene_of_model(scene, model, size);
}

Subject Subject::of_model(const std::filesystem::path& scene_file, const Model& model, Size size,
                          const std::filesystem::path& sky, Executor& executor, double time) {
  const SceneFile file = load_scene(scene_file);
  Subject subject;
  subject.scene_ = scene_of(file, model, size);
  subject.scene_.time = time;
  RenderedPlate plate = render_plate(model, subject.scene_, {.size = size},
                                     renderable(model, subject.scene_), executor);
  sanitise_planes(plate.planes, subject.scene_.water->up);
  subject.frame_ = plate.frame;
  subject.planes_ = std::move(plate.planes);
  if (!file.environment.empty()) {
    subject.environment_ = load_environment(file.environment, file.environment_rotation);
  } else if (!sky.empty()) {
    subject.environment_ = load_environment(sky, 0);
  }
  subject.describe(scene_file, "scene");
  return subject;
}

void Subject::describe(const std::filesystem::path& scene_file, std::string kind) {
  frame_.environment = environment_.texture;
  facts_ = {scene_file.stem().string(), std::move(kind), scene_file.filename().string(),
            window().size(), 0};
}

void Subject::bring(PlaneSet planes) {
  for (int i = 0; i < kPlaneCount; ++i) {
    const bool brought = planes.has(static_cast<PlaneId>(i)) && planes_[i];
    frame_.planes[i] = brought ? std::as_const(planes_[i]).view() : View<const float>{};
  }
  frame_.environment = {};
}

Plan Subject::plan(const Look& look, double max_error, StateSet outputs) const {
  const Inputs inputs{.planes = frame_.present(),
                      .wave_map = !look.of<WaveNormals>().map.empty(),
                      .sun = scene_.sun.has_value(),
                      .environment = static_cast<bool>(frame_.environment),
                      .waves = scene_.has_waves(),
                      .primaries = scene_.primaries};
  return make_plan(look, inputs, outputs, max_error);
}

Frame Subject::frame_for(const Plan& plan) {
  Frame frame = frame_;
  if (plan.reads_wave_map) {
    const std::string& path = plan.look.of<WaveNormals>().map;
    const auto [at, is_new] = wave_maps_.try_emplace(path);
    if (is_new) at->second = load_texture(path);
    frame.wave_map = at->second.texture;
  }
  return frame;
}

}  // namespace limpid

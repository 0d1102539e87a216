#include "job/second_surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/job/missing.h"
#include "limpid/ops/wave_normals.h"

#include "job/composite_inputs.h"
#include "plan/leave_out.h"

namespace limpid {
namespace {

constexpr PlaneSet kSurfacePlanes = kSurfaceNormalPlanes | PlaneSet{PlaneId::kSurfaceDepth};
/// The longer side of the picture, over the width of the margin in which the surface is computed,
/// too: the image of a point may move into the picture from there.
constexpr int kMarginShare = 8;

bool has_plate(const CompositeJob& job) {
  return !files_of(job.plate).empty() && !missing_file(job);
}

Plan plan_of_waves(const Look& look, const Scene& scene, PlaneSet surface) {
  std::vector<std::string> others;
  for (const OperatorInfo& op : operators()) {
    if (op.name != WaveNormals::kName) others.emplace_back(op.name);
  }
  return make_plan_without(others, look,
                           {.planes = kColorPlanes | PlaneSet{PlaneId::kDepth} | surface,
                            .wave_map = !look.of<WaveNormals>().map.empty(),
                            .waves = scene.has_waves(),
                            .primaries = scene.primaries},
                           state_shown_by(std::array{Aov::kNormal, Aov::kSurfaceDepth}));
}

void fill(Plane& plane, const Rect& window, float value) {
  if (plane && plane.view().window == window) return;
  plane = Plane(window);
  for (int y = window.y0; y < window.y1; ++y) {
    std::fill_n(plane.view().row(y), window.width(), value);
  }
}

PreparedSecond prepared(const CompositeJob& job, const Plate& plate, const Scene& scene,
                        const Plan& plan) {
  CompositeJob of_second = job;
  of_second.plate = job.second->plate;
  of_second.scene = job.second->scene;
  of_second.time = job.second->time;
  PreparedSecond second;
  const bool told = of_second.scene.camera && of_second.scene.scene.water;
  if (!told || has_plate(of_second)) second.plate = Plate::open(of_second.plate);
  if (second.plate && second.plate->display() != plate.display()) {
    throw Error("expected the display window of this frame's plate");
  }
  second.scene = scene_of(of_second, second.plate ? *second.plate : plate);
  second.scene.primaries = scene.primaries;
  second.depth = depth_of(of_second);
  Parallax(WaterView(scene, plate.display()), WaterView(second.scene, plate.display()),
           plan.look.water.ior);
  const PlaneSet wanted = plan.planes & kSurfacePlanes;
  if (second.plate) second.surface = wanted & second.plate->planes();
  second.lacks_normals =
      wanted.meets(kSurfaceNormalPlanes) && !second.surface.meets(kSurfaceNormalPlanes);
  second.plan = plan_of_waves(job.look, second.scene, second.surface);
  return second;
}

}  // namespace

std::string PreparedSecond::inputs_text() const {
  return plate && !surface.empty() ? plate->inputs_text(surface) : "";
}

PreparedSecond prepare_second(const CompositeJob& job, const Plate& plate, const Scene& scene,
                              const Plan& plan) {
  try {
    return prepared(job, plate, scene, plan);
  } catch (const Error& error) {
    throw Error(std::string("the ") + (job.second->is_previous ? "previous" : "next") +
                    " frame, for motion vectors: " + error.what(),
                error.fault());
  }
}

void SecondSurface::read(PreparedSecond second) {
  second_ = std::move(second);
  if (second_.surface.empty()) {
    loaded_ = {};
  } else {
    second_.plate->read(second_.surface, second_.scene, second_.depth, loaded_);
  }
  second_.plate.reset();
}

bool SecondSurface::has_waves(const Plan& plan) const {
  return !second_.lacks_normals && (plan.keeps<WaveNormals>() || second_.plan.keeps<WaveNormals>());
}

WaterSurface SecondSurface::paint(const HeldTextures& textures, const Rect& display,
                                  const OutputChoice& choice, Executor& executor) {
  const int margin = std::max(display.width(), display.height()) / kMarginShare;
  const Rect window{display.x0 - margin, display.y0 - margin, display.x1 + margin,
                    display.y1 + margin};
  fill(dry_, window, 0);
  fill(depth_, window, HUGE_VALF);
  Frame frame;
  if (!second_.surface.empty()) frame = loaded_.frame;
  frame.display = display;
  frame.overscan = margin;
  for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
    frame.planes[index_of(id)] = std::as_const(dry_).view();
  }
  frame.planes[index_of(PlaneId::kDepth)] = std::as_const(depth_).view();
  textures.show_in(frame);
  frame.environment = {};
  OutputChoice waves;
  waves.aovs = {Aov::kNormal, Aov::kSurfaceDepth};
  waves.runner = choice.runner == Runner::kReference ? Runner::kReference : Runner::kFused;
  waves.simd = choice.simd;
  waves.wave_samples = choice.wave_samples;
  canvas_for(canvas_, frame.work(), waves)
      .paint(second_.plan, frame, second_.scene, waves, executor);
  const Target& target = canvas_->target();
  const auto& normal = target.of(Aov::kNormal);
  return {target.of(Aov::kSurfaceDepth)[0], normal[0], normal[1], normal[2]};
}

}  // namespace limpid

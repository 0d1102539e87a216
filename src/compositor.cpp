#include "limpid/compositor.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/core/texture_levels.h"
#include "limpid/run/fused.h"

#include "enter/clip_direction.h"
#include "enter/half.h"
#include "enter/host_planes.h"
#include "run/host_outputs.h"

namespace limpid {
namespace {

/// The camera as the chain has it: view space turned to look down -Z, clip space to have y up.
Camera camera_of(Camera camera, const Conventions& conventions) {
  camera.clip = conventions.clip;
  if (conventions.looks_along_plus_z) {
    for (int c = 0; c < 4; ++c) camera.view[c][2] = -camera.view[c][2];
    camera.projection[2] = -camera.projection[2];
  }
  if (conventions.clip_y_down) {
    for (int c = 0; c < 4; ++c) camera.projection[c][1] = -camera.projection[c][1];
  }
  return camera;
}

void validate(const Conventions& conventions) {
  const bool range = conventions.near < conventions.far && std::isfinite(conventions.near) &&
                     std::isfinite(conventions.far);
  if (conventions.depth == DepthKind::kNormalised && !range) {
    throw Error("conventions: depth of kind normalised has near " +
                std::to_string(conventions.near) + " and far " + std::to_string(conventions.far) +
                ", expected near < far, both finite");
  }
  if (conventions.depth_nothing && !std::isfinite(*conventions.depth_nothing)) {
    throw Error("conventions: depth_nothing = " + std::to_string(*conventions.depth_nothing) +
                ", expected a finite number");
  }
}

/// Far enough for any picture, and sums of sides fit into an int.
void validate(const Rect& window) {
  constexpr int kFar = 1 << 29;
  if (window.x0 < -kFar || window.y0 < -kFar || window.x1 > kFar || window.y1 > kFar) {
    throw Error("frame: a window reaches farther than 2^29 pixels");
  }
}

void validate(const CompositorOptions& options) {
  if (!options.gpu) return;
  if (!options.gpu->simd.empty()) {
    throw Error("compositor: the simd of gpu is " + options.gpu->simd +
                ", expected it in the options of the compositor");
  }
  if (options.max_error > 0) {
    throw Error("compositor: max_error = " + std::to_string(options.max_error) +
                ", expected 0 on a GPU, which leaves nothing out");
  }
}

std::optional<GpuRunner> runner_of(const CompositorOptions& options) {
  if (!options.gpu) return {};
  GpuOptions gpu = *options.gpu;
  gpu.simd = options.simd;
  return GpuRunner(gpu);
}

void validate(const HostFrame& host) {
  validate(host.display);
  if (host.display.empty())
    throw Error("frame: the display window is empty, expected at least 1x1");
  for (const HostInput& view : host.planes) validate(view.window);
}

HostOutputs outputs_of(const HostPicture& picture) {
  HostOutputs all;
  std::size_t next = 0;
  for (const HostOutput& view : picture.color) all[next++] = view;
  all[next++] = picture.alpha;
  for (const auto& aov : picture.aovs) {
    for (const HostOutput& view : aov) all[next++] = view;
  }
  return all;
}

/// The inputs of a plan, besides its look.
struct PlannedFor {
  PlaneSet planes;
  std::uint32_t aovs = 0;  ///< bit i: AOV i
  bool sun = false, waves = false;
  Primaries primaries = kRec709;
  friend bool operator==(const PlannedFor&, const PlannedFor&) = default;
};
static_assert(kAovCount <= 32);

PlannedFor planned_for(const HostFrame& host, std::uint32_t aovs) {
  PlannedFor wanted;
  wanted.aovs = aovs;
  for (int i = 0; i < kPlaneCount; ++i) {
    if (host.planes[i]) wanted.planes = wanted.planes | PlaneSet{static_cast<PlaneId>(i)};
  }
  wanted.sun = host.scene.sun.has_value();
  wanted.waves = host.scene.has_waves();
  wanted.primaries = host.scene.primaries;
  return wanted;
}

std::uint32_t aovs_of(const HostPicture& picture) {
  std::uint32_t aovs = 0;
  for (int a = 0; a < kAovCount; ++a) aovs |= (picture.aovs[a][0] ? 1u : 0u) << a;
  return aovs;
}

std::uint32_t aovs_of(const ShaderOptions& options) {
  std::uint32_t aovs = 0;
  for (const Aov aov : options.aovs) aovs |= 1u << static_cast<int>(aov);
  return aovs;
}

StateSet shown_by(std::uint32_t chosen) {
  std::vector<Aov> list;
  for (int a = 0; a < kAovCount; ++a) {
    if ((chosen >> a) & 1u) list.push_back(static_cast<Aov>(a));
  }
  return state_shown_by(list);
}

}  // namespace

struct __attribute__((visibility("hidden"))) Compositor::State {
  Conventions conventions;
  Look look;
  CompositorOptions options;
  const HalfTarget* half = nullptr;
  std::unique_ptr<Executor> pool;  ///< if the host has given none
  Executor* executor = nullptr;

  Frame frame;  ///< as entered; the host sets its textures
  std::vector<std::uint32_t> wave_map_bytes;
  LevelMaker wave_map_levels;
  Scene scene;
  std::optional<Plan> plan;  ///< empty until it is made
  PlannedFor made_for;
  EnteredPlanes planes;
  HostTarget target;
  FusedRunner runner;
  std::optional<GpuRunner> gpu;  ///< in place of the fused runner
  SanitiseCounts replaced;
  bool ran = false;  ///< whether a frame has run with this plan

  void forget_plan() {
    plan.reset();
    ran = false;
  }

  void expect_ran() const {
    if (!ran) throw Error("compositor: no frame has been run since its settings changed");
  }

  void enter_scene(const Scene& host) {
    if (!host.camera) throw Error("the scene has no camera, expected view and projection matrices");
    scene = host;  // keeps the memory of its waves
    scene.camera = camera_of(*host.camera, conventions);
    scene.validate();
    if (conventions.depth == DepthKind::kDevice) expect_clip_direction(*scene.camera);
  }

  Plan plan_for(const PlannedFor& wanted, double max_error) const {
    return limpid::make_plan(look,
                             {.planes = wanted.planes,
                              .wave_map = static_cast<bool>(frame.wave_map),
                              .sun = wanted.sun,
                              .environment = static_cast<bool>(frame.environment),
                              .waves = wanted.waves,
                              .primaries = wanted.primaries},
                             shown_by(wanted.aovs), max_error);
  }

  void make_plan(const PlannedFor& wanted) {
    if (plan && made_for == wanted) return;
    plan.reset();
    plan = plan_for(wanted, options.max_error);
    made_for = wanted;
  }

  EntryRules rules(const HostPlanes& host, const HostOutputs& outputs) const {
    EntryRules rules;
    rules.depth = {.kind = conventions.depth,
                   .near = conventions.near,
                   .far = conventions.far,
                   .camera = &*scene.camera,
                   .display = frame.display,
                   .nothing = conventions.depth_nothing};
    if (scene.water) rules.up = scene.water->up;
    rules.trusted = conventions.trusted;
    rules.half = half;
    for (int i = 0; i < kPlaneCount; ++i) {
      for (const HostOutput& out : outputs) {
        if (overlap(host[i], out))
          rules.written = rules.written | PlaneSet{static_cast<PlaneId>(i)};
      }
    }
    return rules;
  }
};

Compositor::Compositor(const Conventions& conventions, const Look& look,
                       const CompositorOptions& options)
    : state_(std::make_unique<State>()) {
  validate(conventions);
  validate(options);
  constexpr PlaneSet kLeast = kColorPlanes | PlaneSet{PlaneId::kDepth};
  limpid::make_plan(look, {.planes = kLeast}, {},
                    options.max_error);  // refuses an invalid look or max_error
  State& s = *state_;
  s.conventions = conventions;
  s.look = look;
  s.options = options;
  s.half = &half_target(options.simd);
  s.gpu = runner_of(options);
  if (!options.executor) s.pool = make_executor(0);
  s.executor = options.executor ? options.executor : s.pool.get();
}

Compositor::~Compositor() = default;
Compositor::Compositor(Compositor&&) noexcept = default;
Compositor& Compositor::operator=(Compositor&&) noexcept = default;

void Compositor::set_look(const Look& look) {
  look.validate();
  state_->look = look;
  state_->forget_plan();
}

const Look& Compositor::look() const { return state_->look; }

void Compositor::set_wave_map(const Texture& map) {
  if (map) map.validate("wave map");
  State& s = *state_;
  s.wave_map_bytes = map ? pack_bytes(map) : std::vector<std::uint32_t>{};
  s.frame.wave_map = map;
  s.frame.wave_map.bytes = s.wave_map_bytes.empty() ? nullptr : s.wave_map_bytes.data();
  if (map) s.wave_map_levels.make(s.frame.wave_map);
  s.frame.wave_map.levels = map ? &s.wave_map_levels.levels() : nullptr;
  s.forget_plan();
}

void Compositor::set_environment(const Texture& environment) {
  if (environment) environment.validate("environment");
  state_->frame.environment = environment;
  state_->forget_plan();
}

void Compositor::run(const HostFrame& host, const HostPicture& picture) {
  State& s = *state_;
  s.ran = false;
  validate(host);
  const HostOutputs outputs = outputs_of(picture);
  for (const HostOutput& view : outputs) validate(view.window);
  s.enter_scene(host.scene);
  s.make_plan(planned_for(host, aovs_of(picture)));
  s.frame.display = host.display;
  s.replaced = s.planes.enter(host.planes, s.plan->planes, s.rules(host.planes, outputs),
                              *s.executor, s.frame);
  s.frame.validate();
  const Target& target = s.target.prepare(outputs, s.frame.work());
  if (s.gpu) {
    s.gpu->run(*s.plan, s.frame, s.scene, target, *s.executor);
  } else {
    s.runner.run(*s.plan, s.frame, s.scene, target, *s.executor, {.simd = s.options.simd});
  }
  s.target.store(*s.executor, *s.half);
  s.ran = true;
}

ShaderText Compositor::shader(const HostFrame& host, const ShaderOptions& options) {
  State& s = *state_;
  validate(host);
  s.enter_scene(host.scene);
  const Plan plan = s.plan_for(planned_for(host, aovs_of(options)), 0);
  s.frame.display = host.display;
  Frame frame = s.frame;
  EnteredPlanes planes;
  planes.enter(host.planes, plan.planes, s.rules(host.planes, {}), *s.executor, frame);
  frame.validate();
  return ShaderText(plan, frame, s.scene, options);
}

const Plan& Compositor::plan() const {
  state_->expect_ran();
  return *state_->plan;
}

const SanitiseCounts& Compositor::replaced() const {
  state_->expect_ran();
  return state_->replaced;
}

const std::string& Compositor::device() const {
  static const std::string none;
  return state_->gpu ? state_->gpu->device() : none;
}

}  // namespace limpid

#include "job/composite_inputs.h"

#include <cmath>
#include <optional>
#include <utility>

#include "limpid/core/error.h"

#include "job/canvas.h"
#include "job/picture_warnings.h"
#include "job/shared_textures.h"
#include "plan/leave_out.h"
#include "plate/primaries.h"

namespace limpid {
namespace {

/// The working space that the command line or the scene names.
std::optional<Primaries> named_primaries(const CompositeJob& job) {
  return job.primaries ? job.primaries : job.scene.primaries;
}

Primaries primaries_of(const CompositeJob& job, const Plate& plate) {
  const auto named = named_primaries(job);
  return named ? *named : plate.primaries().value_or(kRec709);
}

/// Invalid chromaticities of a plate do not matter if the working space is named.
std::string contradiction(const Primaries& named, const Plate& plate) {
  std::string told;
  try {
    const auto primaries = plate.primaries();
    if (!primaries || agree(*primaries, named)) return "";
    told = to_string(*primaries);
  } catch (const Error&) {
    return "";
  }
  return "the color space is given as " + to_string(named) + ", and the plate names " + told;
}

}  // namespace

Scene scene_of(const CompositeJob& job, const Plate& plate) {
  const SceneFile carried = plate.scene();
  Scene scene = job.scene.scene;
  if (!scene.water) scene.water = carried.scene.water;
  if (!scene.sun) scene.sun = carried.scene.sun;
  if (!scene.sky) scene.sky = carried.scene.sky;
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
  scene.primaries = primaries_of(job, plate);
  scene.time =
      job.time.of(job.scene, plate.has_scene() ? std::optional(carried.scene.time) : std::nullopt);
  return scene;
}

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
  const auto nothing = job.depth_nothing ? job.depth_nothing : scene.depth_nothing;
  return {kind, scene.near.value_or(0), scene.far.value_or(0), nothing};
}

Plan plan_of(const CompositeJob& job, const Plate& plate, const Scene& scene,
             const std::vector<std::string>& left_out) {
  if (!plate.planes().has(PlaneId::kDepth)) plate.refuse_without("depth");
  return make_plan_without(left_out, job.look,
                           {.planes = plate.planes(),
                            .wave_map = !job.look.of<WaveNormals>().map.empty(),
                            .sun = scene.sun.has_value(),
                            .environment = has_environment(job.scene),
                            .waves = scene.has_waves(),
                            .primaries = scene.primaries},
                           state_shown_by(computed_aovs(job.output)), job.output.max_error);
}

std::vector<std::string> warnings_of(const CompositeJob& job, const Plate& plate,
                                     const Plan& plan) {
  std::vector<std::string> warnings = plan.warnings;
  if (const auto named = named_primaries(job)) {
    if (std::string text = contradiction(*named, plate); !text.empty()) {
      warnings.push_back(std::move(text));
    }
  }
  const auto unread = [&](const std::string& what) {
    warnings.push_back(what + " is named, and no running operator of the look " + job.look.name +
                       " reads it");
  };
  for (const Role& role : roles()) {
    const bool named = plate.named_planes().meets(role.planes());
    if (named && !plan.planes.meets(role.planes())) unread("the layer " + std::string(role.name));
  }
  const bool own_normals = plan.look.of<WaveNormals>().model == WaveNormals::Model::kPlate;
  if (job.output.wave_samples > 1 && own_normals) {
    warnings.push_back(
        "wave_samples = " + std::to_string(job.output.wave_samples) +
        " (--samples) changes nothing: the waves are the frame's normals, one per pixel");
  }
  const bool may_mirror_sky = plan.completed.covers(kSkyPlanes);
  if (job.scene.scene.sky && !plan.lit_by_sky && !may_mirror_sky) unread("[sky]");
  if (job.scene.scene.sky && plan.lit_by_sky && plan.reads_environment) {
    warnings.push_back("[sky] has no effect: the environment lights the water");
  }
  if (plan.reads_environment && !agree(plan.primaries, kRec709) &&
      !told_primaries(job.scene.environment)) {
    warnings.push_back("the environment " + job.scene.environment.filename().string() +
                       " names no color space: it is read in that of the plate, " +
                       to_string(plan.primaries));
  }
  // It may stand by for a reflection.
  const bool mirrors = plan.reads_environment || plan.planes.meets(kReflectionPlanes);
  if (has_environment(job.scene) && !mirrors) unread("the environment");
  return warnings;
}

void warn_of_pixels(const CompositeJob& job, const Plan& plan, const Frame& frame,
                    const Scene& scene, double transparent, std::vector<std::string>& warnings) {
  warn_of_picture(plan, frame, scene, warnings);
  warn_of_ambient(plan, frame, scene, warnings);
  if (job.output.wave_samples == 1) warn_of_lamps(plan, frame, warnings);
  warn_of_deep_glass(transparent, warnings);
}

}  // namespace limpid

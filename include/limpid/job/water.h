#pragma once
#include "limpid/files/limits.h"
#include "limpid/job/composite.h"
#include "limpid/job/job_time.h"
#include "limpid/raster/model.h"
#include "limpid/raster/render_plate.h"

namespace limpid {

/// The common part of all jobs with a model: its scene.
struct SceneJob {
  SceneFile scene;  ///< camera and sun, if it has none, come from the model
  JobTime time;
  Limits limits;  ///< for the files of wave map and environment
};

/// `limpid render`: all buffers of the model as one plate with limpid's layer names (color, depth,
/// shadow, reflection, below, surface) and camera, water and sun as attributes. composite() needs
/// no other input, except an environment if the look reads one.
struct PlateOutput {
  std::filesystem::path plate;
  std::string compression = "piz";
  bool store_float = false;  ///< else half; depths are always float
};
struct RenderJob : SceneJob {
  RenderOptions render;
  PlateOutput output;
};
void render(const Model& model, const RenderJob& job, Executor& executor);

inline constexpr int kMaxSamples = 16;

/// `limpid water`: renders and composites without an intermediate file. With samples = N the plate
/// is rendered N times as wide and high, and the composited picture is filtered down, so that no
/// pixel mixes depths.
struct WaterJob : SceneJob {
  RenderOptions render;
  Look look;
  int samples = 1;  ///< 1 ... kMaxSamples
  OutputChoice output;
};

/// Plans without rendering pixels.
Plan plan_water(const Model& model, const WaterJob& job);

/// Renders only the buffers that the plan reads. Throws Error as composite() does.
CompositeReport water(const Model& model, const WaterJob& job, Executor& executor);

}  // namespace limpid

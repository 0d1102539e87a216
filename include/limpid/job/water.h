#pragma once
#include "limpid/files/limits.h"
#include "limpid/job/composite.h"
#include "limpid/job/job_time.h"
#include "limpid/raster/model.h"
#include "limpid/raster/render_plate.h"

namespace limpid {

/// What all jobs over a model have in common: the scene that it is seen in.
struct SceneJob {
  SceneFile scene;  ///< camera and sun come from the model where it has none
  JobTime time;
  Limits limits;  ///< of the files of wave map and environment
};

/// `limpid render`: all buffers of the model as one plate with our own layer names (color, depth,
/// shadow, reflection, below, surface) and camera, water and sun as attributes, so that composite()
/// needs nothing else but the environment, if the look reads one.
struct PlateOutput {
  std::filesystem::path plate;
  std::string compression = "piz";
  bool store_float = false;  ///< half otherwise; depths are float always
};
struct RenderJob : SceneJob {
  RenderOptions render;
  PlateOutput output;
};
void render(const Model& model, const RenderJob& job, Executor& executor);

inline constexpr int kMostSamples = 16;

/// `limpid water`: render and composite without a file between. With samples = N the picture is
/// made N times as wide and high and the finished water filtered down last, so that no pixel mixes
/// depths.
struct WaterJob : SceneJob {
  RenderOptions render;
  Look look;
  int samples = 1;  ///< 1 ... kMostSamples
  OutputChoice output;
};

/// Plans without rendering a pixel.
Plan plan_water(const Model& model, const WaterJob& job);

/// Only the buffers that the plan reads are rendered. Throws Error as composite() does.
CompositeReport water(const Model& model, const WaterJob& job, Executor& executor);

}  // namespace limpid

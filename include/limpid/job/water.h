#pragma once
#include "limpid/files/limits.h"
#include "limpid/job/composite.h"
#include "limpid/raster/model.h"
#include "limpid/raster/render_plate.h"

namespace limpid {

/// What `limpid render` and `limpid water` have in common: a model seen in a scene.
struct RenderJob {
  SceneFile scene;  ///< camera and sun come from the model where it has none
  RenderOptions render;
  double time = 0;  ///< seconds, for the waves
  Limits limits;    ///< of the files of wave map and environment
};

/// `limpid render`: all buffers of the model as one plate with our own layer names (color, depth,
/// shadow, reflection, below, surface) and camera, water and sun as attributes, so that composite()
/// needs nothing else but the environment, if the look reads one.
struct PlateOutput {
  std::filesystem::path plate;
  std::string compression = "piz";
  bool store_float = false;  ///< half otherwise; depths are float always
};
struct PlateJob {
  RenderJob render;
  PlateOutput output;
};
void render(const Model& model, const PlateJob& job, Executor& executor);

inline constexpr int kMostSamples = 16;

/// `limpid water`: render and composite without a file between. With samples = N the picture is
/// made N times as wide and high and the finished water filtered down last, so that no pixel mixes
/// depths.
struct WaterJob {
  RenderJob render;
  Look look;
  int samples = 1;  ///< 1 ... kMostSamples
  OutputChoice output;
};

/// Plans without rendering a pixel.
Plan plan_water(const Model& model, const WaterJob& job);

/// Only the buffers that the plan reads are rendered. Throws Error as composite() does.
CompositeReport water(const Model& model, const WaterJob& job, Executor& executor);

}  // namespace limpid

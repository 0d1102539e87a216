#pragma once
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/texture_levels.h"
#include "limpid/plan/plan.h"

#include "complete/below_overscan.h"
#include "complete/bottom_albedo.h"
#include "complete/bottom_layer.h"
#include "complete/caustics.h"
#include "complete/caustics_mirrored.h"
#include "complete/continuation.h"
#include "complete/displaced_surface.h"
#include "complete/edges.h"
#include "complete/mirror_depth.h"
#include "complete/part_depths.h"
#include "complete/plate_waves.h"
#include "complete/scattered_light.h"
#include "complete/sky.h"
#include "complete/slope_map.h"
#include "op/pass.h"

namespace limpid {

/// Makes the planes of Plan::completed, which nobody rendered, from those that are there, and of
/// the wave map what the plan's waves read where a pixel is wider than a texel; moves depths to the
/// part of each pixel that is seen; parts pixels that something before the water covers in part;
/// draws a layer below the water on as far as color and depth go; makes the continuation of the
/// bottom for rays that leave the picture, the layer of the bottom for those that end behind
/// something, the light that the water scatters more than once, the table of sunlight that
/// waves focus on the bottom; lights by it what the surface mirrors of the bottom. Each only where
/// the plan asks for it. Once a frame, before its pixels; operators read the result as they read
/// the plate's planes. The result does not depend on
/// the number of threads. Keeps its memory from frame to frame.
class Completer {
 public:
  /// The frame with what was made; its views hold until the next call. `context` is that of the
  /// frame as it is. A plane whose inputs the frame lacks is not made. Nothing but views is copied.
  /// `simd` as in FusedOptions; without it formulas run in double.
  Frame complete(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                 const std::string* simd = nullptr);
  /// The same of a frame whose planes tell their windows alone, for their pixels lie elsewhere:
  /// what is made of pixels (made_of_pixels()) is not made.
  Frame complete_windows(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                         const std::string& simd);
  /// Of the last frame: for its pass.
  const PlateWaves& plate_waves() const { return plate_waves_; }
  /// What a plan asks for that is made of pixels, a phrase each.
  static std::vector<std::string> made_of_pixels(const Plan& plan);

 private:
  void complete_surface(PlaneSet made, const Pass& pass, Executor& executor,
                        const std::string* simd, Frame& frame);
  void complete_plate_waves(const Plan& plan, PlaneSet own, const Pass& pass, const Frame& frame);
  void complete_waves(const Plan& plan, const Pass& pass, Executor& executor, Frame& frame);
  void complete_water(const Plan& plan, PlaneSet made, const Pass& pass, Executor& executor,
                      Frame& frame);

  BelowOverscan below_overscan_;
  ContinuationMaker continuation_maker_;
  BottomLayerMaker bottom_layer_;
  DisplacedSurface displaced_surface_;
  Edges edges_;
  PartDepths part_depths_;
  MirrorDepth mirror_depth_;
  Sky sky_;
  PlateWaves plate_waves_;
  LevelMaker level_maker_;
  SlopeMap slope_map_;
  ScatteredLightMaker scattered_light_;
  BottomAlbedo bottom_albedo_;
  CausticsMaker caustics_, shafts_;
  CausticsTable light_;  ///< of both
  MirroredCaustics mirrored_caustics_;
};

}  // namespace limpid

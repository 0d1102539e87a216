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
#include "complete/edge_surfaces.h"
#include "complete/edges.h"
#include "complete/mirror_depth.h"
#include "complete/part_depths.h"
#include "complete/plate_waves.h"
#include "complete/scattered_light.h"
#include "complete/sky.h"
#include "complete/slope_map.h"
#include "complete/sun_share.h"
#include "complete/surface_shadow.h"
#include "op/pass.h"

namespace limpid {

/// Makes missing data from the planes that a frame has: the planes of Plan::completed; the slope
/// map for pixels wider than a texel of the wave map; depths on the rays of a part of each pixel;
/// the parts of pixels that objects in front of the water cover; the layer below the water,
/// extended as far as color and depth; the surfaces at the edge of the picture, for mirrored rays
/// that leave it; the continuation of the bottom for rays that leave the picture; the bottom behind
/// objects, for rays that end there; multiple scattering, and the light of the
/// surroundings for it; the table of caustics, and caustics in
/// the reflection. Each only if the plan needs it. Runs once per frame, before its pixels;
/// operators read the results like the plate's planes. The result does not depend on the number of
/// threads. Keeps its memory from frame to frame.
class Completer {
 public:
  /// The frame with the planes made for it; its views are valid until the next call. `pass` is
  /// that of the original frame. A plane whose inputs the frame lacks is not made. Copies views
  /// only, no pixels. `simd` as in FusedOptions; without it formulas run in double.
  Frame complete(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                 const std::string* simd = nullptr);
  /// The same for a frame whose planes have windows but no pixels here, because the pixels lie on a
  /// device: results made of pixels (made_of_pixels()) are left out.
  Frame complete_windows(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                         const std::string& simd);
  /// Waves of the last frame: for its pass.
  const PlateWaves& plate_waves() const { return plate_waves_; }
  /// The results that a plan needs and that are made of pixels, a phrase each. `has_sky`: whether
  /// the scene tells the sky's light.
  static std::vector<std::string> made_of_pixels(const Plan& plan, bool has_sky);

 private:
  void complete_surface(PlaneSet made, const Pass& pass, Executor& executor,
                        const std::string* simd, Frame& frame);
  void complete_sky(PlaneSet made, const Plan& plan, const Pass& pass, Executor& executor,
                    Frame& frame);
  void complete_plate_waves(const Plan& plan, PlaneSet own, const Pass& pass, const Frame& frame);
  void complete_waves(const Plan& plan, const Pass& pass, Executor& executor, Frame& frame);
  /// `pixels`: whether the values of the frame's planes can be read, beside their windows.
  void complete_water(const Plan& plan, PlaneSet made, bool pixels, const Pass& pass,
                      Executor& executor, Frame& frame);

  BelowOverscan below_overscan_;
  ContinuationMaker continuation_maker_;
  BottomLayerMaker bottom_layer_;
  DisplacedSurface displaced_surface_;
  SurfaceShadow surface_shadow_;
  Edges edges_;
  EdgeSurfacesMaker edge_surfaces_;
  PartDepths part_depths_;
  MirrorDepth mirror_depth_;
  Sky sky_;
  PlateWaves plate_waves_;
  LevelMaker level_maker_;
  SlopeMap slope_map_;
  ScatteredLightMaker scattered_light_;
  BottomAlbedo bottom_albedo_;
  SunShare sun_share_;
  CausticsMaker caustics_, shafts_;
  CausticsTable light_;  ///< of the bottom and of the water
  MirroredCaustics mirrored_caustics_;
};

}  // namespace limpid

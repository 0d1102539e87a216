#pragma once
#include <optional>

#include <glm/vec2.hpp>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/core/state.h"
#include "limpid/core/texture_levels.h"

#include "core/water_view.h"
#include "op/height_bound.h"
#include "op/plate_waves.h"
#include "op/water_medium.h"

namespace limpid {

/// Where planes can be looked up: the centres of their outermost texels, in uv.
struct Bounds {
  glm::dvec2 low, high;
};

/// The waves that raise the water of this frame: where the frame has a depth of its surface, that
/// one tells how high they are.
Swell swell_of(const Frame& frame, Swell swell = {});

/// What all pixels of one run over a frame have in common, made once: the view, and what is at hand
/// for operators, who see planes by their strip alone.
struct Pass : WaterView {
  /// `made`: what the operators of the plan make. Water whose depth the frame has is raised,
  /// whatever `swell` says. Throws Error as WaterView does. The waves of `swell` and all that the
  /// frame refers to must live as long.
  Pass(const Scene& scene, const Frame& frame, double ior, StateSet made, const Swell& swell = {});

  PlaneSet planes;  ///< that the frame has: for operators that take more where there is more
  Bounds dry, below, reflection;  ///< of color with depth, of the two others with theirs
  Bounds surface;                 ///< of the water's depth; `dry` where the frame has none
  bool surface_ends;              ///< before `dry` does: the calm level stands for the rest of it
  Sun sun;                        ///< operators that need one declare it
  bool has_sun;                   ///< for those that do with or without
  double ior;
  Texture wave_map, environment;
  const SlopeLevels* wave_slopes;         ///< of the wave map at this time, or null
  Sym2<double> wave_variance;             ///< likewise, or 0
  const ScatteredLight* scattered_light;  ///< of red, green, blue, or null
  Rgb<double> sky;                        ///< radiance of an even sky, 0 where nobody knows it
  bool has_sky;
  StateSet made;  ///< what the operators of the plan make: neutral or absent ones make nothing
  /// False where it is known that nothing stands before the water in any place that refraction may
  /// look up (plan/survey.h): an operator may leave out its test for that.
  bool foreground = true;
  /// False where it is known that something was hit in every place that refraction may look up: an
  /// operator may leave out its test for nothing().
  bool bottomless = true;
  /// Of what refraction may look up, where a runner has made it (complete/heights.h). It saves
  /// looks and changes no result.
  HeightBound heights = {};
  RangeBound mirrored = {};          ///< likewise, of what the mirror marches over and may hit
  RangeBound lit = {};               ///< likewise, of the shadow on the surface
  PlateWaves plate_waves = {};       ///< of the frame's own surface, where a runner has made it
  const Continuation* continuation;  ///< of the bottom beyond the picture, or null
  const BottomLayer* bottom_layer;   ///< of the bottom behind what stands before it, or null
  const CausticsTable* caustics;     ///< null where nobody has made it: it is not known
  /// What views from within the water see what is mirrored through; nothing where there are none,
  /// or where the plan has no such water.
  std::optional<WaterMedium> medium = {};
  /// Whether an infinite depth of the reflection says that nothing is there: one that was made of
  /// the dry picture does not.
  bool reflection_ends = false;
};

}  // namespace limpid

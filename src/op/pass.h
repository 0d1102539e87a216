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

/// Range of the centres of a plane's outermost texels, in uv.
struct Bounds {
  glm::dvec2 low, high;
};

/// The waves that raise the water of this frame: with a depth of its surface, the frame's own; else
/// `swell`.
Swell swell_of(const Frame& frame, Swell swell = {});

/// Data shared by all pixels of one run over a frame, made once: the view, and inputs for
/// operators, which read planes only through their strip.
struct Pass : WaterView {
  /// `made`: state that the plan's operators make. Water counts as raised if the frame has its
  /// depth, for any `swell`. Throws Error as WaterView does. The waves of `swell` and all data that
  /// the frame refers to must live as long.
  Pass(const Scene& scene, const Frame& frame, double ior, StateSet made, const Swell& swell = {});

  PlaneSet planes;  ///< planes of the frame, for operators that use optional ones
  /// Of the planes of color and depth, of the layer below, and of the reflection.
  Bounds dry, below, reflection;
  Bounds surface;  ///< of the surface depth; `dry` if the frame has none
  /// Whether `surface` lacks a part of `dry` or `below`, where the calm level is used instead.
  bool surface_ends;
  Sun sun;       ///< for operators that declare it as a need
  bool has_sun;  ///< for operators with an optional sun
  double ior;
  Texture wave_map, environment;
  const SlopeLevels* wave_slopes;         ///< of the wave map at this time, or null
  Sym2<double> wave_variance;             ///< likewise, or 0
  const ScatteredLight* scattered_light;  ///< for red, green, blue; or null
  Rgb<double> sky;                        ///< radiance of a uniform sky, 0 without one
  bool has_sky;
  SkyChange sky_change;  ///< of the planes of the sky
  StateSet made;         ///< state that the plan's operators make; neutral or absent ones make none
  /// False if no object stands in front of the water anywhere that refraction may look up
  /// (plan/survey.h): an operator may leave out its test for that.
  bool foreground = true;
  /// False if a surface was hit everywhere that refraction may look up: an operator may leave out
  /// its test for nothing().
  bool bottomless = true;
  /// Bounds on the texels that refraction may look up, if a runner has made them
  /// (complete/heights.h). They save lookups and change no result.
  HeightBound heights = {};
  RangeBound mirrored = {};           ///< likewise, of the depths for mirrored marches
  RangeBound lit = {};                ///< likewise, of the shadow on the surface
  PlateWaves plate_waves = {};        ///< of a raised surface, where a runner has made it
  const EdgeSurfaces* edge_surfaces;  ///< the surfaces at its edge, or null
  const Continuation* continuation;   ///< the bottom beyond the picture, or null
  const BottomLayer* bottom_layer;    ///< the bottom behind objects in front of it, or null
  const CausticsTable* caustics;      ///< null if no completer has made it
  /// The water through which viewers in it see the light that the surface mirrors; nothing if no
  /// view begins in the water, or if no operator of the plan has a medium().
  std::optional<WaterMedium> medium = {};
  /// Whether an infinite depth of the reflection means that the mirrored scene has no surface
  /// there. False for a depth that was computed from the dry picture.
  bool reflection_ends = false;
};

}  // namespace limpid

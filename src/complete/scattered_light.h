#pragma once
#include "limpid/core/vec.h"

#include "optics/scattered_light.h"

namespace limpid {

/// Solves the equation of radiative transfer for a layer of water under sun and sky, per channel,
/// and fits the functions that the chain's pixels evaluate. 1 to 3 ms, twice that if views may
/// begin in the water; the result for the last water is kept.
///
/// The peak of the phase function counts as not scattered (narrow_share); the rest of it is
/// represented by 16 moments fitted, relatively, at all other angles (Hu et al. 2000, "Delta-Fit: a
/// Fast and Accurate Treatment of Particle Scattering Phase Functions"). `sun` leaves out single
/// scattering, which is computed exactly elsewhere (Nakajima & Tanaka 1988, "Algorithms for
/// Radiative Intensity Calculations in Moderately Thick Atmospheres").
class ScatteredLightMaker {
 public:
  /// Red, green, blue; until the next call. `floor`: the bottom, for views from within the water.
  const ScatteredLights& make(const ScatteringWater& water, const WaterFloor& floor = {});

 private:
  ScatteringWater water_;
  WaterFloor floor_;
  bool made_ = false;
  ScatteredLights light_;
};

}  // namespace limpid

#pragma once
#include <array>
#include <memory>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "complete/caustics_level.h"
#include "complete/wave_rows.h"
#include "op/caustics_table.h"
#include "op/pass.h"

namespace limpid {

/// Whether the eye depth tells the slope of the bottom. False if all depths, of one every few
/// pixels, are also numbers of half precision, whose steps would look like slopes. Depths of
/// another kind that were converted to eye depth count as fine.
bool has_fine_depth(const Frame& frame);

/// Traces sunlight down from the waves and accumulates it on the bottom (Arvo 1986, "Backward Ray
/// Tracing", with a regular grid of rays at the surface).
///
/// The bottom's depth comes from the frame's planes, by entry points of calm water, and is extended
/// to entry points of bottom that no view ray meets; if two depths belong to one entry point, their
/// mean counts. The light of a ray is splatted into the table as a box as wide as the distance of
/// neighbouring rays, one to three texels; a filter of three texels along each axis removes that
/// blur, and adds the blur of the sun's disc. The same for any number of threads. Keeps its memory
/// from frame to frame. 5 ms for 1920x1080 pixels on one thread with AVX-512, twice as long where
/// light is focused.
class CausticsMaker {
 public:
  /// Valid until the next call. A table without levels if the sun is down, or if the waves change
  /// the light by less than kLeastContrast, or if `waves` is null. `simd` as in FusedOptions;
  /// without it one ray at a time. `scattering`: of the water, 1/scene unit; scattered light counts
  /// as spread evenly over the bottom. Deeper bottom counts as being at the depth `deepest`; for
  /// views from the air water down to twice that depth counts as visible.
  const CausticsTable* make(const WaveNormals::Params* waves, const Rgb<double>& scattering,
                            const Frame& frame, const Pass& pass, Executor& executor,
                            const std::string* simd = nullptr, double deepest = HUGE_VAL);

  static constexpr double kLeastContrast = 0.002;

 private:
  bool within_water() const { return table_.depth < HUGE_VAL; }
  void look(const Frame& frame, const Pass& pass, const Sunlight& sun, Executor& executor);
  CausticsSight look_at(const Pass& pass, const Sunlight& sun, int x, int y, double depth,
                        bool mirrored) const;
  void lay_out(const WaveRows& waves, const Pass& pass, const Sunlight& sun);
  bool lay_out(const WaveRows& waves, const Pass& pass, const Sunlight& sun, double scale,
               int exponent, double widest, double deepest);

  WaveRows waves_;
  std::vector<CausticsBottom> bottoms_;
  std::vector<CausticsSight> sights_;  ///< one for each kEvery bottoms
  int step_ = 1;                       ///< pixels from one bottom to the next
  std::vector<CausticsLevel> levels_;
  std::vector<float> wanted_;
  std::unique_ptr<Executor> alone_;  ///< for work within a task
  CausticsTable table_;
};

}  // namespace limpid

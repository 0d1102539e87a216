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

/// Traces sunlight down from the waves and accumulates it on the bottom (Arvo 1986, "Backward Ray
/// Tracing", with a regular grid of rays at the surface).
///
/// The bottom's depth is that of the frame's planes, over the place where calm water lets light in,
/// drawn on where no view ray meets it; where two bottoms lie below one place, their mean. The
/// light of a ray goes to the table as a box as wide as neighbouring rays are apart, one to three
/// texels; a filter of three texels along each axis undoes that blur, and blurs by the sun's disc.
/// The same for any number of threads. Keeps its memory from frame to frame. 5 ms for 1920x1080
/// pixels on one thread with AVX-512, twice as long where light is focused.
class CausticsMaker {
 public:
  /// Valid until the next call. A table without levels if the sun is down, or the waves focus less
  /// than kLeastContrast of its light. `simd` as in FusedOptions; without it one ray at a time.
  /// `scattering` is that of the water, 1/scene unit: scattered light counts as spread over all of
  /// the bottom. A bottom deeper than `deepest` counts as that deep, and views from the air count
  /// down to twice that depth.
  const CausticsTable* make(const WaveNormals::Params& waves, const Rgb<double>& scattering,
                            const Frame& frame, const Pass& pass, Executor& executor,
                            const std::string* simd = nullptr, double deepest = HUGE_VAL);

  static constexpr double kLeastContrast = 0.002;

 private:
  void weigh_sun(const Frame& frame, const Pass& pass, Executor& executor);
  bool within_water() const { return table_.depth < HUGE_VAL; }
  void look(const Frame& frame, const Pass& pass, const Sunlight& sun, Executor& executor);
  CausticsSight look_at(const Pass& pass, const Sunlight& sun, int x, int y, double depth,
                        bool mirrored) const;
  void lay_out(const WaveRows& waves, const Pass& pass, const Sunlight& sun);
  bool lay_out(const WaveRows& waves, const Pass& pass, const Sunlight& sun, double scale,
               int exponent, double widest, double deepest);

  struct Weights {
    std::array<double, 3> sun, rest;
  };

  WaveRows waves_;
  std::vector<Weights> weights_;  ///< of rows of the picture
  std::vector<CausticsBottom> bottoms_;
  std::vector<CausticsSight> sights_;  ///< of each kEvery bottoms
  int step_ = 1;                       ///< pixels from one bottom to the next
  std::vector<CausticsLevel> levels_;
  std::vector<float> wanted_;
  std::unique_ptr<Executor> alone_;  ///< for work within a task
  CausticsTable table_;
};

}  // namespace limpid

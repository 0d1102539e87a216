#pragma once
#include <array>
#include <memory>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "complete/pull_push.h"
#include "complete/wave_rows.h"
#include "op/caustics_table.h"
#include "op/pass.h"

namespace limpid {

/// Follows sunlight down from the waves and adds it up where it meets the bottom (Arvo 1986,
/// "Backward Ray Tracing", with a regular grid of rays as they leave the surface).
///
/// The bottom's depth is that of the frame's planes, over the place where calm water lets light in,
/// drawn on where nobody sees it; where two bottoms lie below one place, their mean. Light goes to
/// the table bilinearly; a filter of three texels along each axis undoes what that blurs, and blurs
/// by the sun's disc. The same for any number of threads. Keeps its memory from frame to frame. 20
/// to 35 ms for 1920x1080 pixels on one thread, that of the bottom as that in the water.
class CausticsMaker {
 public:
  /// A table without levels where the sun is down, or the waves focus less than kLeastContrast of
  /// its light. Until the next call. `simd` as in FusedOptions; without it one ray at a
  /// time. `scattering` is that of the water, 1/scene unit: light that is scattered on its way down
  /// is taken for spread over all of the bottom. Where the bottom is deeper than `deepest` the
  /// table is of that depth, and of what views from the air see down to twice as deep.
  const CausticsTable* make(const WaveNormals::Params& waves, const Rgb<double>& scattering,
                            const Frame& frame, const Pass& pass, Executor& executor,
                            const std::string* simd = nullptr, double deepest = HUGE_VAL);

  static constexpr double kLeastContrast = 0.002;

 private:
  /// What is seen of the bottom by one pixel of a few.
  struct Sample {
    float x, y, depth;     ///< where calm water lets light in that goes there; 0: not under water
    float seen_x, seen_y;  ///< the same of what a pixel of the water sees
    float texel;           ///< how wide it wants them; 0: the pixel is dry
    float enters_x, enters_y;  ///< where it begins to see them: there, or where it enters the water
  };
  static constexpr int kBands = 4;   ///< of a level, each splatted on its own
  static constexpr int kCoarse = 2;  ///< texels of the table along a cell of `bottom`
  /// What one band of a level's rays adds to it, and room for one row of them.
  struct Band {
    std::vector<float> light, rows;
    std::vector<int> texels;
    std::vector<SineOfRow> sines;
  };
  struct Level {
    glm::dvec2 corner;
    double texel;
    Size size{0, 0};
    int density;   ///< rays along a texel
    int margin;    ///< texels from beyond the table that send light into it
    double depth;  ///< mean
    std::vector<float>
        bottom;  ///< depths, a value for kCoarse texels, from the corner of the margin
    Size cells{0, 0};
    PullPush<1> filled;
    std::array<Band, kBands> bands;
    Plane light;
  };
  /// Light in the water: how far it goes aside for each unit that it sinks, in calm water.
  struct Sunlight {
    glm::dvec3 to_sun;  ///< along map_x, map_y and up
    glm::dvec2 aside;
    double ior, passes, focus;
    double along, across;  ///< the sun's disc on the bottom, as a deviation, for each unit of depth
    bool low;              ///< so that how much passes the surface changes from wave to wave
  };

  void weigh_sun(const Frame& frame, const Pass& pass);
  bool within_water() const { return table_.depth < HUGE_VAL; }
  void look(const Frame& frame, const Pass& pass, const Sunlight& sun, Executor& executor);
  void lay_out(const WaveRows& waves, const Pass& pass, const Sunlight& sun);
  bool lay_out(const WaveRows& waves, const Pass& pass, const Sunlight& sun, double scale,
               int exponent, double widest, double deepest);
  void find_bottom(Level& level, Executor& executor) const;
  void splat(const WaveRows& waves, const Sunlight& sun, const CausticsTarget& target, Level& level,
             int band) const;
  void finish(const Sunlight& sun, Level& level) const;

  WaveRows waves_;
  std::vector<Sample> samples_;
  std::vector<Level> levels_;
  std::vector<float> wanted_;
  std::unique_ptr<Executor> alone_;  ///< for work within a task
  CausticsTable table_;
};

}  // namespace limpid

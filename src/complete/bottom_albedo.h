#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "op/pass.h"
#include "optics/scattered_light.h"

namespace limpid {

/// The water over a bottom, which returns part of the bottom's light to it.
struct WaterOver {
  const ScatteredLights& light;
  Rgb<double> rate;  ///< a + b, 1/scene unit
  double beam;       ///< cosine of the angle between sunlight and vertical, in the water
};

/// The albedo of surfaces under the calm water, smoothed: their radiance in the dry picture over
/// that of a white level floor in the same light, sun (where `shadow` lets it) and sky, each summed
/// over about two depths of water around. Without `shadow` the depth plane is searched for what
/// hides the sun from the texel in the middle of each cell. Ratios of sums are right in shadows and
/// stay below 1 on walls; ratios of single pixels do not.
///
/// In a narrow basin an endless floor of the same brightness has less: basin() is its share of the
/// albedo. Part of the light that the surface reflects down comes from walls there (Basin), which
/// are darker than the floor: the sun lights only half of them, at its angle to the vertical. Views
/// from within the water use no albedo in this way; views that begin in both use it by the share
/// that begins in the air.
class BottomAlbedo {
 public:
  /// Reads color, depth and, if present, shadow. `sky`: radiance of an even sky. 0 where there is
  /// no bottom near, or no light; else at most 1.
  void make(const Frame& frame, const Pass& pass, const Rgb<double>& sky, const WaterOver& water,
            Executor& executor);

  const Plane& channel(int i) const { return planes_[static_cast<std::size_t>(i)]; }
  /// Of all channels, whose shares differ little; 0 ... 1.
  const Plane& basin() const { return planes_[kBasin]; }

 private:
  static constexpr int kBlock = 4;          ///< cells a side that share a search of walls
  static constexpr std::size_t kBasin = 3;  ///< of planes_

  /// Sums over the texels of a cell. Of three channels: the dry radiance, that of a white level
  /// floor, the shares of walls and of shade. Then the depth under the water, the texels, and the
  /// distance to sum around the cell.
  enum Sum : std::size_t {
    kColor = 0,
    kLight = 3,
    kWalls = 6,
    kShade = 9,
    kDrop = 12,
    kCount,
    kReach,
    kLit  ///< of a cell alone: its lit fraction, without a shadow plane
  };
  using Cell = std::array<float, 16>;
  void gather(const Frame& frame, const Pass& pass, const Rgb<double>& sky, int row);
  void look_for_shade(const View<const float>& depth, const Pass& pass, const Rect& window,
                      int row);
  void look_for_walls(const Frame& frame, const Pass& pass, const WaterOver& water, int row);
  int reach() const;
  static float as_of_level(float albedo, const Cell& sums, std::size_t channel, double sun,
                           double even, const WaterOver& water);
  void spread(int reach, Executor& executor);
  void draw_row(const Rect& window, int y);

  std::array<Plane, 4> planes_;
  int cell_ = 0;  ///< pixels a side
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> cells_, sums_;
  std::vector<std::array<float, 4>> drawn_;  ///< albedo and basin of each cell
};

}  // namespace limpid

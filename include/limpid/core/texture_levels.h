#pragma once
#include <cstdint>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/vec.h"

namespace limpid {

/// The layout of the mip levels of a tiling picture: each level is half as wide and half as high as
/// the level before (rounded down, at least 1), down to a single texel, one level after the other
/// in memory. Each level repeats its first column and row at the end: height + 1 rows of width + 1
/// texels.
struct LevelSizes {
  static constexpr int kMost = 32;
  int count = 0;
  std::int32_t width[kMost] = {}, height[kMost] = {};
  std::int32_t first[kMost] = {};  ///< index of the first texel of each level
  std::int64_t texels = 0;         ///< of all

  Size size(int level) const { return {width[level], height[level]}; }
  std::int32_t place(int level, int x, int y) const {
    return first[level] + y * (width[level] + 1) + x;
  }
};

/// The levels of a picture of this size, at least 1x1, with the picture itself as the first level.
LevelSizes levels_from(Size size);
/// Half the width and half the height, rounded down, at least 1.
Size halved(Size size);

/// The mip levels of a tiling normal map, for pixels that are wider than a texel. Made once per
/// map, by LevelMaker.
struct TextureLevels {
  /// Means of the map's colors, from half the map's size on, as r | g << 11 | b << 22: red and
  /// green in 2047ths, blue in 511ths, each clamped to 0 ... 1.
  LevelSizes sizes;
  const std::uint32_t* texels = nullptr;

  /// Moments of the map's slopes (-n_x, -n_y) / n_z, n_z at least .05, over the texels of `base`:
  /// planes of the means along x and y, and of the second moments xx, xy and yy. `base` is the
  /// map's size, halved until it is at most 512x512.
  static constexpr int kMaxBase = 512;
  static constexpr int kMoments = 5;
  Size base{0, 0};
  int halvings = 0;  ///< number of halvings from the map's size to base
  const float* moments = nullptr;
};

/// Makes the levels of a map and owns them. Allocates no memory after the first map of a size.
class LevelMaker {
 public:
  /// `map` is as Frame::wave_map. NaN counts as 0.
  void make(const Texture& map);
  /// The levels of the last make(), valid until the next one.
  const TextureLevels& levels() const { return levels_; }

 private:
  TextureLevels levels_;
  std::vector<std::uint32_t> texels_;
  std::vector<float> moments_;
};

/// The shift of each of four lookups of a tiling map along its x and y, in periods.
struct FourShifts {
  Vec2<double> of[4];
};

/// The covariance, over a period of the map, of the slopes of the mean of four lookups. Ignores the
/// smoothing by bilinear lookups between texels. A shift of NaN counts as 0.
Sym2<double> slope_variance(const TextureLevels& map, const FourShifts& shifts);

/// Moments of the slopes of all waves of a map at one time, from TextureLevels::base on, in planes
/// of sizes.texels floats: the means along x and y, then xx, xy, yy.
struct SlopeLevels {
  LevelSizes sizes;
  const float* planes[TextureLevels::kMoments] = {};
  double map_texels = 1;  ///< width of a texel of the first level, in texels of the map
};

}  // namespace limpid

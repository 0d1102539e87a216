#pragma once
#include <cstdint>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/vec.h"

namespace limpid {

/// Pictures that repeat, each half as wide and half as high as the one before (rounded down, at
/// least 1), down to a single texel, one after the other in memory. Of each, the first column and
/// row are there once more at the end: width + 1 texels in each of height + 1 rows.
struct LevelSizes {
  static constexpr int kMost = 32;
  int count = 0;
  std::int32_t width[kMost] = {}, height[kMost] = {};
  std::int32_t first[kMost] = {};  ///< texel with which the level begins
  std::int64_t texels = 0;         ///< of all

  Size size(int level) const { return {width[level], height[level]}; }
  std::int32_t place(int level, int x, int y) const {
    return first[level] + y * (width[level] + 1) + x;
  }
};

/// From a picture of this size, at least 1x1, on.
LevelSizes levels_from(Size size);
/// Half as wide and half as high, rounded down, at least 1.
Size halved(Size size);

/// What lookups of a tiling normal map read where a pixel is wider than a texel. Made once a map,
/// by LevelMaker.
struct TextureLevels {
  /// Means of the map's colors, from half the map's size on, as
  /// r | g << 11 | b << 22: red and green in 2047ths, blue in 511ths, each kept to 0 ... 1.
  LevelSizes sizes;
  const std::uint32_t* texels = nullptr;

  /// Of the map's slopes (-n_x, -n_y) / n_z, n_z at least .05, over the texels of `base`: the mean
  /// along x and y, and the moments xx, xy and yy, one plane after the other. The map's size,
  /// halved until it is at most 512x512.
  static constexpr int kMaxBase = 512;
  static constexpr int kMoments = 5;
  Size base{0, 0};
  int halvings = 0;  ///< from the map's size to that of base
  const float* moments = nullptr;
};

/// Makes the levels of a map and owns them. Makes no allocation after the first map of a size.
class LevelMaker {
 public:
  /// The map is as Frame::wave_map. What is not a number counts as 0.
  void make(const Texture& map);
  /// Of the last make(), until the next one.
  const TextureLevels& levels() const { return levels_; }

 private:
  TextureLevels levels_;
  std::vector<std::uint32_t> texels_;
  std::vector<float> moments_;
};

/// How far each of four lookups of a tiling map has gone along its x and y, in periods.
struct FourShifts {
  Vec2<double> of[4];
};

/// How much the mean of four such lookups varies over a period: the covariance of its slopes. To
/// within what bilinear lookups between texels flatten; what is not a number moves nothing.
Sym2<double> slope_variance(const TextureLevels& map, const FourShifts& shifts);

/// Moments of the slopes of all waves of a map at one time, from TextureLevels::base on, in planes
/// of sizes.texels floats: the mean along x and y, then xx, xy, yy.
struct SlopeLevels {
  LevelSizes sizes;
  const float* planes[TextureLevels::kMoments] = {};
  double map_texels = 1;  ///< texels of the map along a texel of the first level
};

}  // namespace limpid

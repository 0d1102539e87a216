#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/rect.h"

#include "complete/rows.h"

namespace limpid {

/// A pyramid of means that extends the known texels of a picture smoothly over the rest of it
/// (Gortler et al. 1996, "The Lumigraph", pull-push). A texel has kChannels values and, last, its
/// known share, 0 ... 1. Keeps its memory from picture to picture.
template <std::size_t kChannels>
class PullPush {
 public:
  using Texel = std::array<float, kChannels + 1>;

  /// A level, with texels from (0, 0) on.
  struct Level {
    Size size{0, 0};
    std::vector<Texel> texels;

    Texel& at(int x, int y) { return texels[static_cast<std::size_t>(y) * size.width + x]; }
    const Texel& at(int x, int y) const {
      return texels[static_cast<std::size_t>(y) * size.width + x];
    }
    /// Bilinear, at texel (x, y) of a level or picture twice as large.
    Texel between(int x, int y) const {
      const int x0 = (x - 1) >> 1, y0 = (y - 1) >> 1;
      const float u = x % 2 == 0 ? 0.75f : 0.25f, v = y % 2 == 0 ? 0.75f : 0.25f;
      Texel sum{};
      for (int k = 0; k < 4; ++k) {
        const int column = std::clamp(x0 + (k & 1), 0, size.width - 1);
        const int row = std::clamp(y0 + (k >> 1), 0, size.height - 1);
        const float weight = (k & 1 ? u : 1 - u) * (k >> 1 ? v : 1 - v);
        add(sum, at(column, row), weight);
      }
      return mean(sum);
    }
  };

  /// Half of a picture of this size, in which texel(x, y) is known by the share in its last value.
  template <class At>
  void begin(Size picture, Executor& executor, At&& texel) {
    if (levels_.empty()) levels_.resize(1);
    reduce(picture, levels_[0], executor, texel);
  }
  /// The level of begin(), or memory for a level that the caller fills.
  Level& finest(Size size) {
    if (levels_.empty()) levels_.resize(1);
    Level& level = levels_[0];
    level.size = size;
    level.texels.resize(static_cast<std::size_t>(size.width) * size.height);
    return level;
  }
  const Level& finest() const { return levels_[0]; }

  /// False, without a result, if no texel is known.
  bool draw_on(Executor& executor) {
    std::size_t count = 1;
    for (Size s = levels_[0].size; s.width > 1 || s.height > 1; s = half_of(s)) ++count;
    if (levels_.size() < count) levels_.resize(count);
    for (std::size_t i = 1; i < count; ++i) {
      const Level& finer = levels_[i - 1];
      reduce(finer.size, levels_[i], executor, [&](int x, int y) { return finer.at(x, y); });
    }
    if (!(levels_[count - 1].at(0, 0)[kChannels] > 0)) return false;
    for (std::size_t i = count - 1; i > 0; --i) fill(levels_[i - 1], levels_[i], executor);
    return true;
  }

 private:
  static Size half_of(Size size) { return {(size.width + 1) / 2, (size.height + 1) / 2}; }

  static void add(Texel& sum, const Texel& texel, float weight) {
    const float known = weight * texel[kChannels];
    for (std::size_t i = 0; i < kChannels; ++i) sum[i] += known * texel[i];
    sum[kChannels] += known;
  }
  static Texel mean(const Texel& sum) {
    if (!(sum[kChannels] > 0)) return {};
    Texel texel;
    for (std::size_t i = 0; i < kChannels; ++i) texel[i] = sum[i] / sum[kChannels];
    texel[kChannels] = std::min(sum[kChannels], 1.0f);
    return texel;
  }

  template <class At>
  static void reduce(Size finer, Level& level, Executor& executor, At&& texel) {
    level.size = half_of(finer);
    level.texels.resize(static_cast<std::size_t>(level.size.width) * level.size.height);
    each_row(executor, {0, 0, level.size.width, level.size.height}, [&](int y) {
      for (int x = 0; x < level.size.width; ++x) {
        Texel sum{};
        for (int k = 0; k < 4; ++k) {
          const int column = 2 * x + (k & 1), row = 2 * y + (k >> 1);
          if (column < finer.width && row < finer.height) add(sum, texel(column, row), 1);
        }
        level.at(x, y) = mean(sum);
      }
    });
  }

  /// Fills the unknown part of a level from the coarser level, which is fully known.
  static void fill(Level& finer, const Level& coarser, Executor& executor) {
    each_row(executor, {0, 0, finer.size.width, finer.size.height}, [&](int y) {
      for (int x = 0; x < finer.size.width; ++x) {
        Texel& texel = finer.at(x, y);
        const float known = texel[kChannels];
        if (known >= 1) continue;
        const Texel rest = coarser.between(x, y);
        for (std::size_t i = 0; i < kChannels; ++i)
          texel[i] = rest[i] + known * (texel[i] - rest[i]);
        texel[kChannels] = 1;
      }
    });
  }

  std::vector<Level> levels_;
};

}  // namespace limpid

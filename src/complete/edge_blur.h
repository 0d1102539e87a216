#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "limpid/core/executor.h"

#include "complete/edge_picture.h"

namespace limpid {

/// How far edges are blurred: of steps between a dry pixel and a wet one that lies behind it, how
/// the difference of color grows with the distance between the two that are compared. At a hard
/// edge it is there at once, at a blurred one it grows until both are out of the blur.
class EdgeBlur {
 public:
  /// Distances from the step to each side, in pixels.
  static constexpr std::array<int, 7> kLadder{0, 1, 3, 7, 15, 31, 63};
  static constexpr int kWidths = 6;  ///< how many of them an edge can be blurred by

  /// Sums over steps of the products of the differences of color at distance i of the ladder with
  /// themselves, with the next and, at the first two, with that after; each step counts by its
  /// relative contrast, and not where that goes out of the picture. The
  /// last two: squares of the differences between distance i and the next on one side alone.
  struct Growth {
    std::array<double, kWidths> own{}, next{}, dry{}, wet{};
    std::array<double, 2> after{};
    int steps = 0, speckled = 0;  ///< how many they are, and how many of Step::speckle
    void add(const Growth& other);
    bool grows_at(int rung) const;
    /// Where on the ladder the difference is full. 0: at a hard edge, or none, and where color
    /// changes as much on both sides of the edge as across it, as light does, but for sides that
    /// alternate from pixel to pixel, as in depth of one sample of many.
    int full_at() const;
  };

  /// Between two pixels side by side.
  struct Step {
    int x, y;   ///< of the left or upper one
    bool down;  ///< whether the other is below, and not to the right
    bool dry_first;
    bool speckle;  ///< at a pixel that is alone of its side in its row
  };

  explicit EdgeBlur(const EdgePicture& picture) : picture_(picture) {}

  /// Whether some edge is blurred, by a look at some rows.
  /// `sides` and `steps` are room that it uses.
  bool any(std::vector<std::uint8_t>& sides, std::vector<Step>& steps) const;

  /// Adds the steps of the row y, and from it to the next. `sides` are of both, from window.x0 on;
  /// `below` is null in the last row.
  void find(int y, const std::uint8_t* sides, const std::uint8_t* below,
            std::vector<Step>& steps) const;

  Growth growth_of(const Step& step, int rungs) const;

 private:
  bool occludes(const Step& step) const;

  const EdgePicture& picture_;
};

}  // namespace limpid

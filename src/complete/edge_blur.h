#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "limpid/core/executor.h"

#include "complete/edge_picture.h"

namespace limpid {

/// Width of the blur at edges: at steps between a dry pixel and a wet pixel behind it, the
/// difference of color as a function of the distance between the two compared pixels. At a hard
/// edge it is full at once; at a blurred edge it grows until both pixels are outside the blur.
class EdgeBlur {
 public:
  /// Distances from the step to each side, in pixels.
  static constexpr std::array<int, 7> kLadder{0, 1, 3, 7, 15, 31, 63};
  static constexpr int kWidths = 6;  ///< number of possible widths

  /// Sums over steps of the products of the color differences at distance i of the ladder with
  /// themselves, with the next and, at the first two, with the one after that; each step counts by
  /// its relative contrast, and not where the ladder leaves the picture. The last two: squares of
  /// the differences between distance i and the next on one side alone.
  struct Growth {
    std::array<double, kWidths> own{}, next{}, dry{}, wet{};
    std::array<double, 2> after{};
    /// Number of steps, of those with Step::speckle, and of those that grow up to distance 1.
    int steps = 0, speckled = 0, grown = 0;
    void add(const Growth& other);
    bool grows_at(int rung) const;
    /// Whether the sums grow up to distance 1, or most of the steps do.
    bool is_blurred() const;
    /// Whether many sides are one pixel wide: objects thinner than a pixel, or sides that alternate
    /// at random.
    bool is_speckled() const;
    /// The first distance on the ladder with full difference. 0: a hard edge or none, and where
    /// color changes as much beside the edge as across it, like a change of light; but not for
    /// sides that alternate from pixel to pixel, as in depth taken from one sample of many.
    int full_at() const;
  };

  /// A step between two neighbouring pixels.
  struct Step {
    int x, y;   ///< of the left or upper one
    bool down;  ///< whether the other pixel is below instead of to the right
    bool dry_first;
    bool speckle;  ///< a pixel that is the only one of its side in its row
  };

  explicit EdgeBlur(const EdgePicture& picture) : picture_(picture) {}

  /// Whether any edge is blurred, by some sampled rows. `sides` and `steps` are scratch memory.
  bool any(std::vector<std::uint8_t>& sides, std::vector<Step>& steps) const;

  /// Adds the steps within the row y, and to the next row. `sides` and `below` are the sides of
  /// both, from window.x0 on; `below` is null in the last row.
  void find(int y, const std::uint8_t* sides, const std::uint8_t* below,
            std::vector<Step>& steps) const;

  Growth growth_of(const Step& step, int rungs) const;

 private:
  bool occludes(const Step& step) const;

  const EdgePicture& picture_;
};

}  // namespace limpid

#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"

namespace limpid {

/// Pixels of half the width and height: the full pixels (2 i, 2 j), (2 i + 1, 2 j) and the two
/// below, counted from `corner`, become the half pixel (i, j). At the edges of a window, only the
/// pixels within it count.
struct Halving {
  int corner_x = 0, corner_y = 0;

  /// The window of all half pixels that overlap it.
  Rect of(const Rect& window) const;
  /// The full pixels that the half window covers.
  Rect covered(const Rect& half) const;
};

/// The mean of the existing pixels.
Plane half_mean(const View<const float>& plane, const Halving& halving);

/// A frame of half the size with the same view: colors, shadows and shares by their mean (a
/// reflection's color by that of its valid pixels), normals by their mean direction, depths by one
/// of the four pixels, always the same, because a mean of two depths lies on no surface.
class HalfPlate {
 public:
  /// The corner of `frame`'s work() becomes (0, 0).
  HalfPlate(const Frame& frame, Executor& executor);

  /// Views of this plate; without textures.
  const Frame& frame() const { return frame_; }
  /// The camera of the half frame, which covers one more column or row if the frame has an odd
  /// number.
  Camera camera(const Camera& of_frame) const;
  const Halving& halving() const { return halving_; }

 private:
  Rect display_;
  Halving halving_;
  Frame frame_;
  std::vector<Plane> planes_;
  std::array<Plane, 4> foreground_;
};

}  // namespace limpid

#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"

namespace limpid {

/// Pixels of half the width and height: of the window in whole pixels those (2 i, 2 j), (2 i + 1,
/// 2 j) and the two below, counted from `corner`, are the one (i, j). Where a window begins or ends
/// between two such, what there is of them counts.
struct Halving {
  int corner_x = 0, corner_y = 0;

  /// The window of all half pixels of which a part lies in it.
  Rect of(const Rect& window) const;
  /// What the half window covers in whole pixels.
  Rect covered(const Rect& half) const;
};

/// The mean of the pixels there are.
Plane half_mean(const View<const float>& plane, const Halving& halving);

/// A frame of half the size that shows the same view: colors, shadows and shares by their mean (a
/// reflection's color by that of its valid pixels), normals by their mean direction, depths by one
/// pixel of the four, the same for all, for a mean of depths is where nothing is.
class HalfPlate {
 public:
  /// The corner of `frame`'s work() becomes the half one's, (0, 0).
  HalfPlate(const Frame& frame, Executor& executor);

  /// Views of this plate; without textures.
  const Frame& frame() const { return frame_; }
  /// The camera as it sees the half frame: that covers a column or row more where the frame has an
  /// odd number of them.
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

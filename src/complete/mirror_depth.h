#pragma once
#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "core/water_view.h"

namespace limpid {

/// The depth of a reflection that came without one, and which of its pixels are real. A depth and a
/// validity that the reflection has are kept, but for the insides of things.
///
/// Each point of the dry scene on the eye's side of the calm water is put where its mirror image is
/// seen; the nearest one wins. Small holes, between points that lie farther apart in the mirror
/// than in the picture, get the greatest depth of their neighbours, and edges grow by up to two
/// pixels. What the dry scene does not show remains infinitely far, as the sky is.
///
/// A renderer that cuts the scene at the water shows objects that stand in it from within. A pixel
/// at which something dry stands before the water counts as such an inside where no mirror image is
/// known, and where the water lies hardly farther than that thing, at most 0.15 of its depth: the
/// image of what is behind would be seen through its foot. So it does within three pixels of the
/// line in which that thing meets the water where what is seen there lies farther, even if it is
/// told to be real. An inside is not real, and a ray that comes there has met that thing.
class MirrorDepth {
 public:
  /// Looks at depth, at the window of the reflection, and at reflection_depth and reflection_valid
  /// where they are there.
  void make(const Frame& frame, const WaterView& view, Executor& executor);

  const Plane& depth() const { return depth_; }  ///< eye depth, +inf where nothing is known
  const Plane& valid() const { return valid_; }  ///< 1 or 0

 private:
  Plane depth_, valid_;
};

}  // namespace limpid

#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "core/water_view.h"

namespace limpid {

/// The depth of a reflection that has none, and its valid pixels. A depth and a validity that the
/// reflection has are kept, except inside objects.
///
/// Each point of the dry scene on the eye's side of the calm water is splatted at its mirror image;
/// the nearest point wins. Small holes, between points farther apart in the mirror than in the
/// picture, get the greatest depth of their neighbours, and edges grow by up to two pixels. Pixels
/// that the dry scene does not fill remain infinitely far, like the sky. But what a side of the dry
/// picture cuts goes on to the side of the reflection, along a plane, while the reflection's colors
/// are alike, over a quarter of its width at most, and up and down to outlines of these colors
/// (mirror_outlines.h).
///
/// A renderer that clips the scene at the water shows the insides of objects that stand in it. A
/// pixel with a dry object in front of the water counts as such an inside if no mirror image is
/// known there, and the water behind the object is at most 0.15 of the object's depth farther away:
/// the mirror image would show through the foot of the object. A pixel within three pixels of the
/// object's water line counts as an inside, too, if the mirror image there is farther, and within
/// one pixel of it in any case, even if the reflection marks it as valid. An inside is not valid,
/// and a ray that reaches it has met the object.
class MirrorDepth {
 public:
  /// Reads depth, the colors of the reflection, and reflection_depth and reflection_valid if
  /// present.
  void make(const Frame& frame, const WaterView& view, Executor& executor);

  const Plane& depth() const { return depth_; }  ///< eye depth, +inf where it is not known
  const Plane& valid() const { return valid_; }  ///< 1 or 0

 private:
  static constexpr int kBand = 32;  ///< rows that a thread completes one after the other
  /// Rows of depths whose holes are closed once: the outermost of the band, for its neighbours,
  /// too, and the last three others.
  struct Band {
    std::vector<float> first, last;
    std::array<std::vector<float>, 3> recent;
  };
  template <class Then>
  void close_holes(Executor& executor, const Then& then);

  Plane depth_, valid_;
  std::vector<Band> bands_;
};

}  // namespace limpid

#pragma once
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "complete/bottom_plane.h"
#include "op/continuation.h"
#include "op/pass.h"

namespace limpid {

/// Makes the bottom for rays that leave the picture under water. Samples a few thousand texels of
/// the planes that refraction looks up, mostly at their edges.
class ContinuationMaker {
 public:
  /// Null if no ray of the water leaves the picture: then only the plane of the bottom was fitted.
  /// Valid until the next call.
  const Continuation* make(const Frame& frame, const Pass& pass);

 private:
  void paint_edge(const Frame& frame, const Pass& pass, const BottomPlane& plane);

  Continuation continuation_;
  Plane colors_[3];
  // Near a place of the edge: colors under the water, and heights of the bottom over the plane.
  std::vector<Rgb<float>> near_;
  std::vector<double> heights_;
  // Texels of the bottom, and their slopes.
  std::vector<BottomSample> samples_;
  std::vector<glm::dvec2> slopes_;
};

}  // namespace limpid

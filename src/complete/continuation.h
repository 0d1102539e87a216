#pragma once
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "complete/bottom_plane.h"
#include "op/continuation.h"
#include "op/pass.h"

namespace limpid {

/// Makes what rays see that leave the picture under the water. Looks at a few thousand texels of
/// what refraction looks up, on its edges most.
class ContinuationMaker {
 public:
  /// Null, for which nothing but the plane of the bottom was looked for, where no ray of the
  /// water leaves the picture. Valid until the next call.
  const Continuation* make(const Frame& frame, const Pass& pass);

 private:
  void paint_edge(const Frame& frame, const Pass& pass);

  Continuation continuation_;
  Plane colors_[3];
  // Room for texels near a place of the edge, those of the bottom, and how they change.
  std::vector<Rgb<float>> near_;
  std::vector<BottomSample> samples_;
  std::vector<glm::dvec2> slopes_;
};

}  // namespace limpid

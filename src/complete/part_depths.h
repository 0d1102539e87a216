#pragma once
#include <array>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "core/water_view.h"

namespace limpid {

/// The depths of a frame on the rays of a part of each pixel (Scene::part): each point is as high
/// over the calm water there as at the pixel's centre, so that a pixel remains wet or dry. What
/// stands over the water is at most as deep as at the centre. Where such a ray does not reach that
/// height, the depth is that of the centre.
class PartDepths {
 public:
  /// Planes of depths that are read at rays of pixels.
  static constexpr std::array kPlanes{PlaneId::kDepth, PlaneId::kSurfaceDepth,
                                      PlaneId::kBelowDepth};

  /// Puts depths of its own in the place of those that the frame has; they hold until the next
  /// call. `context` is that of the part.
  void move(Frame& frame, const WaterView& view, Executor& executor);

 private:
  std::array<Plane, kPlanes.size()> depths_;
};

}  // namespace limpid

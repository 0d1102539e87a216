#pragma once
#include <array>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "core/water_view.h"

namespace limpid {

/// The depths of a frame on the rays of a part of each pixel (Scene::part): each point keeps the
/// height over the calm water that it has at the pixel's centre, so that a pixel remains wet or
/// dry. Points over the water are at most as deep as at the centre. Where such a ray does not reach
/// that height, the depth is that of the centre.
class PartDepths {
 public:
  /// Depth planes that are read along pixel rays.
  static constexpr std::array kPlanes{PlaneId::kDepth, PlaneId::kSurfaceDepth,
                                      PlaneId::kBelowDepth};

  /// Replaces the depths of the frame by own planes; they are valid until the next call. `view`
  /// is that of the part.
  void move(Frame& frame, const WaterView& view, Executor& executor);

 private:
  std::array<Plane, kPlanes.size()> depths_;
};

}  // namespace limpid

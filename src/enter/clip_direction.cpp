#include "enter/clip_direction.h"

#include "limpid/core/error.h"
#include "limpid/optics/depth.h"

namespace limpid {
namespace {

/// Device depth (z_scale z + z_offset) / (w_scale z + w_offset) grows with the distance -z
/// everywhere if this is positive.
double device_depth_growth(const Camera& camera) {
  const DeviceDepth rows = device_depth_of(camera);
  return rows.z_offset * rows.w_scale - rows.z_scale * rows.w_offset;
}

}  // namespace

void expect_clip_direction(const Camera& camera) {
  const double growth = device_depth_growth(camera);
  if (growth == 0) {
    throw Error("camera: the projection gives every distance the same device depth");
  }
  const bool reversed = camera.clip == ClipSpace::kReversed;
  if ((growth < 0) == reversed) return;
  throw Error(reversed
                  ? "camera: the projection's device depth grows with distance, expected it to "
                    "fall for clip = reversed"
                  : "camera: the projection's device depth falls with distance, expected "
                    "clip = reversed");
}

}  // namespace limpid

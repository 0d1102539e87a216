#pragma once
#include "judge/trace/beam.h"
#include "judge/trace/surface.h"

namespace limpid::trace {

/// The beam after refraction into the water, and out of it: at the plane of the surface there, with
/// its normal. Rays that the normal would send to the wrong side of the geometry are tilted to run
/// along it.
Beam refracted_in(const Beam& beam, const SurfacePoint& at, double ior);
Beam refracted_out(const Beam& beam, const SurfacePoint& at, double ior);
Beam mirrored_up(const Beam& beam, const SurfacePoint& at);
Beam mirrored_down(const Beam& beam, const SurfacePoint& at);

}  // namespace limpid::trace

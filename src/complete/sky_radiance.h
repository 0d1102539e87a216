#pragma once
#include "limpid/core/frame.h"

namespace limpid {

/// The radiance of an even sky that lights level water as an environment does: the mean of the
/// directions above the horizon, weighted by their cosine with the water's up. Samples some hundred
/// rows and columns of a large map.
Rgb<double> sky_radiance(const Texture& environment);

}  // namespace limpid

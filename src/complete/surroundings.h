#pragma once
#include "limpid/core/executor.h"
#include "limpid/core/frame.h"

#include "op/pass.h"

namespace limpid {

/// The radiance of an even sky that lights the water as `sky` does together with the surfaces
/// around, which hide a part of it and send the light that the picture shows: the mean over the
/// directions above the horizon, weighted by their cosine with the water's up, and over the water
/// of the picture. Reads color and depth, on a grid.
///
/// An object hides the sky from the water's level up to its top, a crown or a cable only itself.
/// Surfaces that the upper edge of the picture cuts go on to half of the rest. In directions in
/// which the picture shows neither surfaces nor water nor horizon, as behind the viewer, half as
/// much is hidden as elsewhere. With `closed`, 0 ... 1, of a room (EdgeSurfaces::closed) surfaces
/// go on to the ceiling, and hide all that the picture does not show. `sky` itself for views from
/// below the water, or without water in the picture. Depths of 0 and below count as no surface.
/// Colors that are negative, NaN or inf count as black.
Rgb<double> surroundings(const Frame& frame, const Pass& pass, const Rgb<double>& sky,
                         double closed, Executor& executor);

}  // namespace limpid

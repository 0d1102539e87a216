#pragma once
#include <string>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/plan/plan.h"

#include "complete/bottom_plane.h"

namespace limpid {

/// Adds a sentence for each of these probable mistakes. The frame has been checked.
///
/// - No pixel of Frame::work() is wet, or all are, seen from the air: then water, camera and depth
///   do not fit together.
/// - The depth is nearly constant, or in 0 ... 1 everywhere, as that of a mist pass is.
/// - Part of the picture has an alpha between 0 and 1 and a depth, as glass has: it counts as
///   opaque.
/// - The reflection shows the sun's disc, which the highlight adds, too.
/// - The plate has no shadow for a sun below 20 degrees outside of the picture, and the sun's glint
///   is in the picture.
/// - A period of the tiling waves is smaller than two of the nearest water's pixels, or so large
///   that the whole picture shows a hundredth of it; or waves are higher than the camera.
/// - Sines are to raise the water, but the plate has a level surface.
/// - Caustics use the frame's own normals: the light of a tenth of the bottom or more enters where
///   the frame has none.
/// - Sunlight on slopes is to be refracted, but all eye depths have half precision.
/// - The water mirrors a guessed sky.
///
/// Samples few pixels, unless the picture is all wet or all dry.
void warn_of_picture(const Plan& plan, const Frame& frame, const Scene& scene,
                     std::vector<std::string>& warnings);

/// Adds a sentence if waves mirror a picture that has a quarter of its light in some pixels 16
/// times as bright as its mean, like lamps at night: one sample a pixel does not resolve their
/// images. Plates with normals of their own have no more samples. Samples some hundred rows and
/// columns.
void warn_of_lamps(const Plan& plan, const Frame& frame, std::vector<std::string>& warnings);

/// The sky that lights the water in place of depth_fog.ambient; empty if that does.
std::string sky_over_water(const Plan& plan, const Frame& frame, const Scene& scene);

/// Adds a sentence if depth_fog.ambient is not the default, and has no effect.
void warn_of_ambient(const Plan& plan, const Frame& frame, const Scene& scene,
                     std::vector<std::string>& warnings);

/// Adds a sentence if a thousandth of the wet pixels or more is LoadedPlate::transparent.
void warn_of_deep_glass(double share, std::vector<std::string>& warnings);

/// The lookups of the plan's refraction that leave the picture; none if it traces no rays.
OffFrameLookups off_frame_lookups_of(const Plan& plan, const Frame& frame, const Scene& scene);

/// Adds to_text(off_frame) if it is true of a hundredth of the wet pixels or more.
void warn_of_off_frame(const OffFrameLookups& off_frame, std::vector<std::string>& warnings);

/// Throws the first warning as an Error, if `strict`.
void refuse_warnings(bool strict, const std::vector<std::string>& warnings);

}  // namespace limpid

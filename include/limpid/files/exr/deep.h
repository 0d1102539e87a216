#pragma once
#include <array>

#include "limpid/core/plane.h"
#include "limpid/enter/sanitise.h"
#include "limpid/files/exr/exr_file.h"

namespace limpid {

/// A deep picture with a water surface in it, flattened as a whole, in front of the surface and
/// behind it. All planes have the window of the surface. Colors are premultiplied.
struct DeepLayers {
  std::array<Plane, 4> color;  ///< R G B A of all samples
  Plane depth;                 ///< of the nearest sample with any alpha; +inf: none
  /// R G B behind the surface, as if nothing were in front; 0 where there is no water.
  std::array<Plane, 3> below_color;
  Plane below_depth;  ///< of the nearest such sample with any alpha; +inf: none
  /// R G B A in front of the surface; 0 where there is no water. None without a surface.
  std::array<Plane, 4> foreground;
  /// Share of the pixels with water whose nearest sample behind it is a transparent point with
  /// others behind, as in all pixels around: glass, or a wide blur.
  double transparent = 0;
  SanitiseCounts replaced;  ///< color and depth, by value
};

/// Reads the channels R G B A Z, and where they are there ZBack AR AG AB, of a deep part and
/// flattens them by OpenEXR's "Interpreting Deep Pixels": samples may lie in any order, volume
/// samples that overlap one another or a point are split and merged, and one that spans the surface
/// is split there, so that its depth below is that of the surface. A point on the surface is not
/// behind it. The picture is read block by block, never all of its samples at once.
///
/// `surface` is the depth of the surface, +inf where there is no water, measured as Z is (eye
/// depth, or the distance from the camera for both, and then for the results too); its data may be
/// null where no pixel has water. It may reach beyond the data window, where there are no samples.
///
/// Depths of 1e9 and above, 6e4 in half, mean "no surface hit": such a sample (a sky) is behind
/// everything and its depth +inf. A sample whose Z is NaN or -inf is left out. A sample without a
/// finite back above its front is a point. NaN and -inf in colors and alphas become 0, +inf the
/// largest half, then alphas are clamped to 0 ... 1. Throws Error that names a missing channel, and
/// as ExrFile::read_deep().
DeepLayers read_deep_layers(const ExrFile& file, int part, View<const float> surface);

}  // namespace limpid

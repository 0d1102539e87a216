#pragma once
#include <array>

#include "limpid/core/plane.h"
#include "limpid/enter/sanitise.h"
#include "limpid/files/exr/exr_file.h"

namespace limpid {

/// A deep picture with a water surface in it, flattened three times: all samples, those in front of
/// the surface, those behind it. All planes have the window of the surface. Colors are
/// premultiplied.
struct DeepLayers {
  std::array<Plane, 4> color;  ///< R G B A, of all samples
  Plane depth;                 ///< of the nearest sample with an alpha above 0; +inf without one
  /// R G B of the samples behind the surface; 0 where there is no water.
  std::array<Plane, 3> below_color;
  Plane below_depth;  ///< of the nearest such sample with an alpha above 0; +inf without one
  /// R G B A of the samples in front of the surface; 0 where there is no water. Empty without a
  /// surface.
  std::array<Plane, 4> foreground;
  /// Share of the pixels with water whose nearest sample behind the surface is a transparent point
  /// with other samples behind it, and whose neighbours are alike: glass, or a wide blur.
  double transparent = 0;
  SanitiseCounts replaced;  ///< of color and depth
};

/// Reads the channels R G B A Z and, if present, ZBack AR AG AB of a deep part, and flattens the
/// samples by OpenEXR's "Interpreting Deep Pixels": samples may have any order; volume samples that
/// overlap one another or a point are split and merged; a volume sample that spans the surface is
/// split there, so that the depth of its lower part is that of the surface. A point on the surface
/// is not behind it. The picture is read block by block, never with all samples in memory.
///
/// `surface` is the depth of the surface, +inf where there is no water, of the same kind as Z: eye
/// depth, or distance from the camera, which is then the kind of the results, too. Its data may be
/// null if no pixel has water. Its window may extend beyond the data window, where there are no
/// samples.
///
/// Depths of 1e9 and above, 6e4 in half, mean "no surface hit": such a sample (the sky) is behind
/// all others, with a depth of +inf. A sample with a Z of NaN or -inf is left out. A sample is a
/// point unless its ZBack is finite and above Z. NaN and -inf in colors and alphas become 0, +inf
/// the largest half, then alphas are clamped to 0 ... 1. Throws Error that names a missing channel,
/// and as ExrFile::read_deep().
DeepLayers read_deep_layers(const ExrFile& file, int part, View<const float> surface);

}  // namespace limpid

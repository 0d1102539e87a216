#pragma once
#include <span>
#include <string>
#include <vector>

#include "limpid/files/exr/exr_writer.h"
#include "limpid/job/output.h"
#include "limpid/plate/plate.h"

namespace limpid {

/// The maps of a picture's lookups: Aov::kStmapG, and Aov::kSurfaceDepth, which is +inf on dry
/// pixels.
struct LookedUp {
  View<const float> u, v, surface_depth;
  Rect display;
};

/// Motion vectors of the picture from pairs of planes with vectors of the dry picture, in pixels, x
/// to the right, y up: each pixel has the vector of the texel that it looked up, transformed by the
/// inverse of the map's slopes. Exact to the first order of the motion if camera and water stand
/// still; where the map folds, jumps or stretches twofold and more, the texel's vector is not
/// transformed. Vectors that are not finite become 0.
void carry_motion(const LookedUp& looked_up, View<const float> x, View<const float> y,
                  View<float> to_x, View<float> to_y);

/// The vectors of a plate's layers, as channels of a picture.
class MotionChannels {
 public:
  /// Reads the layers' planes.
  void read(const Plate& plate, std::vector<MotionLayer> layers);
  /// Carries the vectors to the pixels that show their texels.
  void carry(const LookedUp& looked_up, const Rect& window);
  /// Of a file; half unless all is stored as float.
  std::vector<ExrOutputChannel> channels(const OutputChoice& choice) const;

 private:
  std::vector<MotionLayer> layers_;
  std::vector<Plane> dry_, seen_;  ///< one a channel, of all layers
};

/// Their names in a file.
std::vector<std::string> motion_names(const MotionLayer& layer, AovNames names);

}  // namespace limpid

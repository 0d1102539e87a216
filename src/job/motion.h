#pragma once
#include <span>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/files/exr/exr_writer.h"
#include "limpid/job/output.h"
#include "limpid/plate/plate.h"

#include "core/water_view.h"

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

/// What tells where a picture's mirrored rays end: Aov::kSurfaceDepth, Aov::kNormal and
/// Aov::kReflectionDepth, the plate's depth, and the view that all are of.
struct Mirrored {
  View<const float> surface_depth, normal_x, normal_y, normal_z, reflection_depth, depth;
  const WaterView& view;
};

/// The vectors of what the surface mirrors, as carry_motion() has them. The mirrored ray ends as
/// far behind the surface as the mirror's picture says at the pixel; what the picture shows in that
/// place moves as its vector says, at its own eye depth, and its image in the plane through the
/// surface, across the normal, with it. Exact for movement at one eye depth over calm water, where
/// camera and water stand still; of waves the pixel's own slope alone counts. 0 on dry pixels,
/// where the ray ends nowhere, beyond the picture or behind what the picture shows (by 5 % of the
/// depth).
void reflect_motion(const Mirrored& mirrored, View<const float> x, View<const float> y,
                    View<float> to_x, View<float> to_y);

class Parallax;

/// The vectors of a plate's layers, or those to a second frame, as channels of a picture.
class MotionChannels {
 public:
  /// Reads the layers' planes.
  void read(const Plate& plate, std::vector<MotionLayer> layers);
  /// Takes the names of the one layer that leads to a second frame.
  void expect_second(std::vector<MotionLayer> layers);
  /// Computes its vectors, of both kinds.
  void carry(const Parallax& parallax, const LookedUp& looked_up, View<const float> depth,
             const Rect& window, Executor& executor);
  void reflect(const Parallax& parallax, const Mirrored& mirrored, const Rect& window,
               Executor& executor);
  /// Carries the vectors to the pixels that show their texels.
  void carry(const LookedUp& looked_up, const Rect& window);
  /// And to where it mirrors them.
  void reflect(const Mirrored& mirrored, const Rect& window);
  /// Of a file, as far as it asks for them; half unless all is stored as float.
  std::vector<ExrOutputChannel> channels(const OutputChoice& choice) const;

 private:
  std::vector<MotionLayer> layers_;
  std::vector<Plane> dry_, seen_, reflected_;  ///< one a channel, of all layers
};

/// Whether an output has vectors of either kind.
inline bool has_motion(const OutputChoice& choice) {
  return choice.motion || choice.motion_reflected;
}
/// Their names in a file: "motion.X", or "motion_reflected.X".
std::vector<std::string> motion_names(const MotionLayer& layer, AovNames names, bool reflected);

}  // namespace limpid

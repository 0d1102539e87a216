#pragma once
#include <array>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"
#include "limpid/ops/caustics.h"

#include "op/caustics_table.h"
#include "op/pass.h"

namespace limpid {

/// Caustics on the bottom as the surface mirrors it to a view from within the water (beyond the
/// critical angle the surface mirrors all light). Each pixel of the reflection planes is lit by
/// focused light as Caustics lights the bottom, at the point whose mirror image it shows; slopes
/// and shadows stay as by straight sunlight.
///
/// The depth of that point below the surface is the height of its image over the surface, by the
/// reflection's depth. The sun's share in its light comes from the dry picture, if that shows the
/// point; else it is the share of sunlit bottoms (SunShare), if sunlight is refracted, or that of
/// sun and sky, by the shadow on the surface at the entry point. If no plane shows the entry point
/// either, the point counts as lit.
class MirroredCaustics {
 public:
  /// Replaces the views of the frame's reflection, if the eye is in the water and the reflection
  /// has a depth; valid until the next call. `table` is the one of CausticsMaker for this frame;
  /// `pass` has the frame's planes.
  void light(const Caustics::Params& params, const CausticsTable& table, const Pass& pass,
             Executor& executor, Frame& frame);

 private:
  std::array<Plane, 3> color_;
};

}  // namespace limpid

#pragma once
#include <array>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"
#include "limpid/ops/caustics.h"

#include "op/caustics_table.h"
#include "op/pass.h"

namespace limpid {

/// The net of light on what a view from within the water sees of the bottom in the surface, which
/// mirrors all of the light beyond the critical angle: the reflection planes, each pixel lit as
/// Caustics lights a pixel of the bottom, at the point whose mirror image it shows.
///
/// That point lies as deep as the reflection's depth puts its image high. Of its light the sun's
/// share is what the dry picture tells, should it show the point too; else as much as sunlit
/// bottoms have, where frames say that, or what sun and sky send, by the shadow on the surface
/// where light enters to it. Where no plane shows that place, either, it counts as lit.
class MirroredCaustics {
 public:
  /// Replaces the views of the frame's reflection, if the eye is in the water and the reflection
  /// has a depth; holds until the next call. `table` is that of all that is seen, as CausticsMaker
  /// makes it of this frame; `pass` knows the frame's planes.
  void light(const Caustics::Params& params, const CausticsTable& table, const Pass& pass,
             Executor& executor, Frame& frame);

 private:
  std::array<Plane, 3> color_;
};

}  // namespace limpid

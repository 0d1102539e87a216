#pragma once
#include <array>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"
#include "limpid/ops/caustics.h"

#include "op/caustics_table.h"
#include "op/pass.h"

namespace limpid {

/// Caustics on the bottom that the surface mirrors to a view from within the water; beyond the
/// critical angle it mirrors all light: the reflection planes, each pixel lit as Caustics lights a
/// pixel of the bottom, at the point whose mirror image it shows.
///
/// That point lies as deep as the reflection's depth puts its image high. The sun's share in its
/// light comes from the dry picture, if it shows the point; else it is that of sunlit bottoms, for
/// frames that have it, or that of sun and sky, by the shadow on the surface at the entry point.
/// Where no plane shows the entry point either, the point counts as lit.
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

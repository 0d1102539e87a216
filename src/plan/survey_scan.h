#pragma once
#include "limpid/core/plane.h"
#include "limpid/core/rect.h"
#include "limpid/op/context.h"

namespace limpid {

struct LowHigh {
  float low, high;
};

/// Which pixels of a cell are wet, and how the water lies there. Where the frame has no plane of
/// the surface, the calm one is computed in float, and not to the same bits as in a run: what
/// cannot be told for sure counts for wet.
struct WetSeen {
  int wet;                          ///< pixels, at most
  int sure;                         ///< pixels, at least
  float surface_near, surface_far;  ///< eye depth of the surface where it is wet
  float own_near, own_far;          ///< dry eye depth less the surface's, there
};

/// How far off calm depths may be: of `over` and `under` in RowRays.
struct CalmError {
  float over, under;
};

/// The look at the planes, as compiled for one instruction set. Rectangles lie within the windows.
struct ScanTarget {
  LowHigh (*range)(const View<const float>& view, const Rect& pixels);
  WetSeen (*wet)(const Context& context, const CalmError& error, const View<const float>& depth,
                 const View<const float>& surface, const Rect& pixels);
};

}  // namespace limpid

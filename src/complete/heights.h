#pragma once
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/plan/plan.h"

#include "op/pass.h"

namespace limpid {

struct ScanTarget;

/// Makes bounds that save lookups: the HeightBound for refracted lookups, the RangeBound of the
/// depths for mirrored rays, and the RangeBound of the shadow on the surface.
///
/// Each texel has bounds for all rays through it: the greatest and the least height of its surface,
/// or +inf if a ray does not lead down. SeenHeights::highest ignores surfaces above the highest
/// water, which a march passes, and infinitely distant surfaces, such as empty parts of a layer
/// below.
class Heights {
 public:
  /// Reads a frame that has been checked (the runners do that), with the Pass of the plan. `simd`
  /// as in FusedOptions. Makes no heights if the plan does not march, or if water may be seen from
  /// below; no ranges if no operator marches over the plane or looks it up. Allocates no memory
  /// after the first frame of a size.
  void make(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
            const std::string& simd = {});

  /// From the last make(), until the next one.
  const HeightBound& bound() const { return bound_; }
  const RangeBound& mirrored() const { return mirrored_; }
  const RangeBound& lit() const { return lit_; }

 private:
  void look_at_mirrored(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                        const ScanTarget& target);
  void look_below(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                  const ScanTarget& target);

  // Cells of all levels.
  std::vector<SeenHeights> heights_;
  std::vector<SeenRange> depths_, shadows_;
  std::vector<float> water_;  ///< greatest heights, of the first level alone
  HeightBound bound_;
  RangeBound mirrored_, lit_;
};

}  // namespace limpid

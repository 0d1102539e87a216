#pragma once
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/plan/plan.h"

#include "op/pass.h"

namespace limpid {

struct ScanTarget;

/// Makes what saves an operator looks at a frame: the HeightBound of what refraction may look up,
/// the RangeBound of the depths that the mirror may meet, and that of the shadow on the surface.
///
/// Each texel counts with the greatest height, and with the least, at which any ray through it may
/// see it, or +inf where one does not lead down. What stands higher than the highest water does not
/// count for SeenHeights::highest, for a march passes it by, nor does what is infinitely far, as
/// where a layer below is empty.
class Heights {
 public:
  /// Looks at a frame that has been checked (the runners do that), with the Pass that the plan
  /// runs with. `simd` as in FusedOptions. No heights are known then where the plan does not march,
  /// or where water may be seen from below; no ranges are where no operator marches over the plane
  /// or looks it up. Makes no allocation after the first frame of a size.
  void make(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
            const std::string& simd = {});

  /// Of the last make(), until the next one.
  const HeightBound& bound() const { return bound_; }
  const RangeBound& mirrored() const { return mirrored_; }
  const RangeBound& lit() const { return lit_; }

 private:
  void look_at_mirrored(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                        const ScanTarget& target);
  void look_below(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
                  const ScanTarget& target);

  // Of all levels.
  std::vector<SeenHeights> heights_;
  std::vector<SeenRange> depths_, shadows_;
  std::vector<float> water_;  ///< greatest heights, of the first level alone
  HeightBound bound_;
  RangeBound mirrored_, lit_;
};

}  // namespace limpid

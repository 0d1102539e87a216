#pragma once
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/op/context.h"
#include "limpid/plan/plan.h"

namespace limpid {

/// Makes the HeightBound of a frame: how high stands what refraction's march may look up.
///
/// Each texel counts with the greatest height at which any ray through it may see it, or +inf where
/// one does not lead down. What stands higher than the highest water does not count, for a march
/// passes it by, nor does what is infinitely far, as where a layer below is empty.
class Heights {
 public:
  /// Looks at a frame that has been checked (the runners do that), with the Context that the plan
  /// runs with. `simd` as in FusedOptions. Nothing is known then where the plan does not march, or
  /// where water may be seen from below. Makes no allocation after the first frame of a size.
  void make(const Plan& plan, const Frame& frame, const Context& context, Executor& executor,
            const std::string& simd = {});

  /// Of the last make(), until the next one.
  const HeightBound& bound() const { return bound_; }

 private:
  struct Scan;  // one look at one plane
  void stack_levels(Size blocks);

  std::vector<float> heights_;  ///< of all levels
  HeightBound bound_;
};

}  // namespace limpid

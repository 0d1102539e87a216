#pragma once
#include <functional>
#include <vector>

#include "shade/recording.h"

namespace limpid {

/// The lookups of a loop whose places follow from its index alone: a shader starts those of kSteps
/// steps together, where each step would wait for its own. (NVIDIA H100: `fast` takes .81 of the
/// time, `physical` .96; 2, 3 and 6 steps are slower.)
struct LookAhead {
  static constexpr int kSteps = 4;

  std::vector<int> lookups;
  std::vector<int> places;  ///< the nodes that the lookups need, in order

  /// Empty for a loop of fewer steps. `is_ready(node)`: whether the printer writes the node as a
  /// number of the frame, so that it is not computed in the loop.
  LookAhead(const Recording& recording, const Flow& loop, const std::function<bool(int)>& is_ready);
};

}  // namespace limpid

#pragma once
#include <array>

#include "limpid/core/frame.h"
#include "limpid/op/context.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

namespace limpid {

/// Everything that one tile of the fused pass needs; checked before, trusted in the loops.
struct FusedJob {
  const Plan& plan;
  const Frame& frame;
  const Context& context;
  const Target& target;
  std::array<bool, Chain::kCount> keeps;   ///< Plan::keeps
  std::array<float, kPlaneCount> missing;  ///< Role::missing
  std::array<float, kAovCount> dry_aov;    ///< AovInfo::dry
};

/// The fused pass as compiled for one instruction set.
struct FusedTarget {
  const char* name;  ///< as in --simd
  int lanes;         ///< floats a vector
  void (*run_tile)(const FusedJob& job, const Rect& tile);
};

}  // namespace limpid

#pragma once
#include <array>
#include <cstdint>

#include "limpid/core/frame.h"
#include "limpid/plan/survey.h"
#include "limpid/run/target.h"

#include "op/pass.h"

namespace limpid {

/// Measures the operators of a run. Behind an interface, for the code that is compiled for one
/// instruction set must not instantiate anything of the standard library.
class StopClock {
 public:
  static constexpr int kRest = Chain::kCount;  ///< what is no operator's: loading and storing
  using Laps = std::array<std::int64_t, Chain::kCount + 1>;
  virtual ~StopClock() = default;
  virtual std::int64_t now() = 0;
  /// Of one tile, on any thread.
  virtual void add(const Laps& laps) = 0;
};

/// Everything that one tile of the fused pass needs; checked before, trusted in the loops.
struct FusedJob {
  const Plan& plan;
  const Frame& frame;
  const Pass& pass;
  const Pass* passes;  ///< the same as cells need it, see kPasses
  const Target& target;
  const CellNeeds* cells = nullptr;  ///< Survey, rows of them from the corner of Frame::work()
  int cells_across = 0;
  std::array<bool, Chain::kCount> keeps{};      ///< Plan::keeps
  std::array<StateSet, Chain::kCount> makes{};  ///< what each operator makes
  std::array<float, kPlaneCount> missing{};     ///< Role::missing
  std::array<float, kAovCount> dry_aov{};       ///< AovInfo::dry
  /// Planes in which the same index finds the same pixel as in the depth, and the two texels of a
  /// row lie side by side.
  std::array<bool, kPlaneCount> like_depth{};
  StateSet begins{};           ///< state that is read before an operator of the plan makes it
  bool writes_aovs = false;    ///< whether the target has any
  StopClock* clock = nullptr;  ///< only for a run that is timed

  static constexpr int kPasses = 4;  ///< open or not, and 2 more where grounded
};

/// The fused pass as compiled for one instruction set.
struct FusedTarget {
  const char* name;  ///< as in --simd
  int lanes;         ///< floats a vector
  void (*run_tile)(const FusedJob& job, const Rect& tile);
};

}  // namespace limpid

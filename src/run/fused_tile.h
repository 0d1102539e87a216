#pragma once
#include <array>
#include <cstdint>

#include "limpid/core/frame.h"
#include "limpid/plan/survey.h"
#include "limpid/run/target.h"

#include "op/pass.h"

namespace limpid {

/// Measures the time of a run's operators. An interface, because code that is compiled for one
/// instruction set must not instantiate templates of the standard library.
class StopClock {
 public:
  static constexpr int kRest = Chain::kCount;  ///< work outside of operators: loading and storing
  using Laps = std::array<std::int64_t, Chain::kCount + 1>;
  virtual ~StopClock() = default;
  virtual std::int64_t now() = 0;
  /// Adds the times of one tile, from any thread.
  virtual void add(const Laps& laps) = 0;
};

/// The input of one tile of the fused pass; checked before, trusted in the loops.
struct FusedJob {
  const Plan& plan;
  const Frame& frame;
  const Pass& pass;
  const Pass* passes;  ///< variants of the pass for the needs of cells, see kPasses
  const Target& target;
  const CellNeeds* cells = nullptr;  ///< Survey, rows of cells from the corner of Frame::work()
  int cells_across = 0;
  std::array<bool, Chain::kCount> keeps{};      ///< Plan::keeps
  std::array<StateSet, Chain::kCount> makes{};  ///< what each operator makes
  std::array<float, kPlaneCount> missing{};     ///< Role::missing
  std::array<float, kAovCount> dry_aov{};       ///< AovInfo::dry
  /// Planes that have the depth's index for each pixel, and in which the two texels of a row are
  /// adjacent.
  std::array<bool, kPlaneCount> like_depth{};
  StateSet begins{};           ///< state that is read before an operator of the plan makes it
  bool writes_aovs = false;    ///< whether the target has AOVs
  StopClock* clock = nullptr;  ///< null unless the run is timed

  static constexpr int kPasses = 4;  ///< open or not, and 2 more where grounded
};

/// The fused pass, compiled for one instruction set.
struct FusedTarget {
  const char* name;  ///< as in --simd
  int lanes;         ///< floats per vector
  void (*run_tile)(const FusedJob& job, const Rect& tile);
};

}  // namespace limpid

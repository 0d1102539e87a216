#pragma once
#include <array>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/host_view.h"
#include "limpid/core/plane.h"
#include "limpid/run/target.h"

#include "enter/half.h"

namespace limpid {

constexpr int kOutputCount = 4 + 3 * kAovCount;
/// Color, alpha, and three for each AOV.
using HostOutputs = std::array<HostOutput, kOutputCount>;

/// Where a runner writes a picture for a host: into the host's memory, if that takes floats, else
/// into planes of its own, whose numbers are stored afterwards. Memory is kept: none is allocated
/// after the first frame of a size.
class HostTarget {
 public:
  /// Throws Error for a view that does not cover `work`, or whose pixels share a byte with one
  /// another or with those of another view, and for an AOV without its first channel.
  const Target& prepare(const HostOutputs& host, const Rect& work);
  /// What the runner left in planes of its own.
  void store(Executor& executor, const HalfTarget& half) const;

 private:
  Target target_;
  Rect work_;
  std::array<Plane, kOutputCount> planes_;
  std::array<HostOutput, kOutputCount> stored_;  ///< those that are not written by the runner
};

}  // namespace limpid

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
/// Color, alpha, and three channels per AOV.
using HostOutputs = std::array<HostOutput, kOutputCount>;

/// The target of a runner for a host: the host's memory, if it has floats, else own planes, which
/// are converted and stored afterwards. Memory is kept: none is allocated after the first frame of
/// a size.
class HostTarget {
 public:
  /// Throws Error for a view that does not cover `work`, or whose pixels share a byte with one
  /// another or with another view, and for an AOV without its first channel.
  const Target& prepare(const HostOutputs& host, const Rect& work);
  /// Stores the runner's results from the own planes.
  void store(Executor& executor, const HalfTarget& half) const;

 private:
  Target target_;
  Rect work_;
  std::array<Plane, kOutputCount> planes_;
  std::array<HostOutput, kOutputCount> stored_;  ///< views that the runner does not write itself
};

}  // namespace limpid

#pragma once
#include <array>
#include <memory>
#include <stop_token>
#include <string>

#include "limpid/core/error.h"
#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/core/simd.h"
#include "limpid/plan/plan.h"
#include "limpid/plan/survey.h"
#include "limpid/run/target.h"

namespace limpid {

/// Thrown by a run that was interrupted by FusedOptions::stop. The target is then incomplete: some
/// tiles may be written, others not.
struct Stopped : Error {
  Stopped() : Error("stopped: the picture is no longer wanted") {}
};

/// Throws Stopped if a stop is requested.
inline void expect_wanted(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped();
}

/// The time of a run in seconds, summed over all threads. Reading the clock makes a timed run some
/// percent slower.
struct RunTimes {
  std::array<double, Chain::kCount> operators{};  ///< in chain order
  double rest = 0;                                ///< loading, starting and storing pixels
};

struct FusedOptions {
  /// The instruction set by name: scalar sse4 avx2 avx512 neon, or "" for the best of this machine.
  /// An unknown name, or a set that the machine lacks, is refused.
  std::string simd = {};
  Size tile = {256, 64};      ///< pixels
  RunTimes* times = nullptr;  ///< receives the times, if not null
  /// Whether ray marches (of refraction, mirrored rays, the skyline, shadows) skip lookups that
  /// cannot change the result, by the depth bounds of Heights. Does not change the bits; false is
  /// for tests.
  bool leaps = true;
  /// After a stop request no further tile begins, and the run throws Stopped.
  std::stop_token stop = {};
};

/// The fast runner: one pass over tiles in float SIMD lanes, no intermediate pictures. Before it, a
/// survey finds the operators that each cell of the picture needs (plan/survey.h). The bits of the
/// result depend on plan, frame, scene and instruction set, not on threads, tile size or order.
/// Error against run_reference: see docs/benchmarks.md; Plan::max_error adds to it. Numbers below
/// 1.2e-38 count as 0, but are copied unchanged. Keeps its memory from frame to frame: none is
/// allocated after the first frame of a size, except for edges that are blurred in more pixels than
/// before. One run at a time.
class FusedRunner {
 public:
  FusedRunner();
  FusedRunner(FusedRunner&&) noexcept;
  FusedRunner& operator=(FusedRunner&&) noexcept;
  ~FusedRunner();

  /// Throws Error as run_reference() does, and for an instruction set that is not available;
  /// Stopped after a stop request. A plane may span at most 2^31 floats.
  void run(const Plan& plan, const Frame& frame, const Scene& scene, const Target& target,
           Executor& executor, const FusedOptions& options = {});

  /// The survey of the last frame.
  const Survey& survey() const;

 private:
  struct Kept;  // from frame to frame
  std::unique_ptr<Kept> kept_;
};

/// The same for a single frame.
void run_fused(const Plan& plan, const Frame& frame, const Scene& scene, const Target& target,
               Executor& executor, const FusedOptions& options = {});

}  // namespace limpid

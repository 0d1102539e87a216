#pragma once
#include <functional>
#include <limits>
#include <span>

namespace limpid {

/// The clock: CPU time of the calling thread, which other programs hardly affect, or wall-clock
/// time for work with threads of its own.
enum class Clock { kThread, kWall };

/// Work to be timed.
struct Timed {
  std::function<void()> run;
  Clock clock = Clock::kThread;
  double best_seconds = std::numeric_limits<double>::infinity();
};

/// Runs all in turn, round after round, so that other load of the machine affects all equally;
/// keeps the best time of each.
void time_rounds(std::span<Timed> work, int rounds);

}  // namespace limpid

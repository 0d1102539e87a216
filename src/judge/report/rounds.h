#pragma once
#include <functional>
#include <limits>
#include <span>

namespace limpid {

/// Whose time is told: that of the calling thread on its processor, which other programs hardly
/// touch, or the wall's, where the work has threads of its own.
enum class Clock { kThread, kWall };

/// Work whose time is of interest.
struct Timed {
  std::function<void()> run;
  Clock clock = Clock::kThread;
  double best_seconds = std::numeric_limits<double>::infinity();
};

/// Runs all in turn, round after round, so that what else the machine does hits all alike; the best
/// time of each is kept.
void time_rounds(std::span<Timed> work, int rounds);

}  // namespace limpid

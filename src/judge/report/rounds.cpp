#include "judge/report/rounds.h"

#include <algorithm>
#include <ctime>

namespace limpid {
namespace {

double seconds(Clock clock) {
  std::timespec now{};
  ::clock_gettime(clock == Clock::kThread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

void time_rounds(std::span<Timed> work, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (Timed& timed : work) {
      const double start = seconds(timed.clock);
      timed.run();
      timed.best_seconds = std::min(timed.best_seconds, seconds(timed.clock) - start);
    }
  }
}

}  // namespace limpid

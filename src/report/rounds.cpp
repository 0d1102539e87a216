#include "report/rounds.h"

#include <algorithm>

#include "stopwatch.h"

namespace limpid {

void time_rounds(std::span<Timed> work, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (Timed& timed : work) {
      Stopwatch watch;
      timed.run();
      timed.best_seconds = std::min(timed.best_seconds, watch.lap());
    }
  }
}

}  // namespace limpid

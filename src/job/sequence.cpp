#include "limpid/job/sequence.h"

#include <string>

#include "limpid/core/error.h"

#include "job/frame_line.h"
#include "job/stopwatch.h"

namespace limpid {

void check(const Sequence& sequence) {
  if (sequence.in_flight < 1 || sequence.in_flight > kMaxInFlight) {
    throw Error("frames in flight = " + std::to_string(sequence.in_flight) + ": expected 1 ... " +
                    std::to_string(kMaxInFlight),
                Fault::kUsage);
  }
}

void run_sequence(const Sequence& sequence,
                  const std::function<std::unique_ptr<FrameSlot>()>& make_slot,
                  Executor& executor) {
  check(sequence);
  std::vector<std::unique_ptr<FrameSlot>> slots(
      static_cast<std::size_t>(frames_in_flight(sequence)));
  for (auto& slot : slots) slot = make_slot();
  const auto slot = [&](int place) -> FrameSlot& {
    return *slots[static_cast<std::size_t>(place)];
  };
  Stopwatch watch;
  SequenceProgress progress{.total = static_cast<int>(sequence.frames.size())};
  const FrameStep steps[] = {
      [&](int place, int frame) { slot(place).begin(frame); },
      [&](int place, int) { slot(place).read(executor); },
      [&](int place, int) { slot(place).run(executor); },
      [&](int place, int) { slot(place).write(); },
      [&](int place, int frame) {
        progress.frame = frame;
        ++progress.done;
        progress.seconds += watch.lap();
        slot(place).done(progress);
      },
  };
  run_steps(sequence, steps, executor);
}

}  // namespace limpid

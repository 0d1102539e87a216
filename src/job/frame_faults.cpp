#include "job/frame_faults.h"

#include <optional>

#include "limpid/core/error.h"

#include "job/frame_line.h"

namespace limpid {

std::vector<FrameFault> faults_of_frames(
    const Sequence& sequence, const std::function<std::function<void()>(int frame)>& check_of,
    Executor& executor) {
  check(sequence);
  struct Checked {
    std::function<void()> check;
    std::optional<std::string> fault;
  };
  std::vector<Checked> places(static_cast<std::size_t>(frames_in_flight(sequence)));
  const auto at = [&](int place) -> Checked& { return places[static_cast<std::size_t>(place)]; };
  const auto noting = [](Checked& checked, const std::function<void()>& work) {
    try {
      work();
    } catch (const Error& error) {
      checked.fault = error.what();
    }
  };
  std::vector<FrameFault> faults;
  const FrameStep steps[] = {
      [&](int place, int frame) {
        at(place) = {};
        noting(at(place), [&] { at(place).check = check_of(frame); });
      },
      [&](int place, int) {
        if (at(place).check) noting(at(place), at(place).check);
      },
      [&](int place, int frame) {
        if (at(place).fault) faults.push_back({frame, *at(place).fault});
      },
  };
  run_steps(sequence, steps, executor);
  return faults;
}

}  // namespace limpid

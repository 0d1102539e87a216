#include "job/frame_line.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <mutex>
#include <new>
#include <optional>
#include <string>

#include "limpid/core/error.h"

namespace limpid {
namespace {

/// The path of frames through the steps, and the first failure. Frame i has the place i %
/// in_flight, which is free by then, as Executor::pipeline promises.
class Line {
 public:
  Line(const Sequence& sequence, std::span<const FrameStep> steps)
      : frames_(sequence.frames), places_(frames_in_flight(sequence)), steps_(steps) {}

  void go(Executor& executor) {
    constexpr std::array kTasks{&step<0>, &step<1>, &step<2>, &step<3>, &step<4>};
    const std::array<Executor::Task, 5> tasks{kTasks};
    executor.pipeline(static_cast<int>(frames_.size()), places_,
                      std::span(tasks).first(steps_.size()), this);
    if (failure_) throw *failure_;
  }

 private:
  int frame(int index) const { return frames_[static_cast<std::size_t>(index)]; }

  /// One step of a frame, skipped if this frame or one before it has failed.
  template <std::size_t kStep>
  static void step(void* context, int index) {
    Line& line = *static_cast<Line*>(context);
    if (index >= line.failed_.load()) return;
    try {
      line.steps_[kStep](index % line.places_, line.frame(index));
    } catch (const Error& error) {
      line.fail(index, error);
    } catch (const std::bad_alloc&) {
      line.fail(index, no_memory());
    } catch (const std::exception& error) {
      line.fail(index, Error(error.what()));
    } catch (...) {
      line.fail(index, Error("failed for an unknown reason"));
    }
  }

  void fail(int index, const Error& error) {
    const std::lock_guard lock(mutex_);
    if (index >= failed_.load()) return;
    failed_ = index;
    failure_.emplace("frame " + std::to_string(frame(index)) + ": " + error.what(), error.fault());
  }

  const std::vector<int>& frames_;
  int places_;
  std::span<const FrameStep> steps_;
  std::mutex mutex_;
  std::atomic<int> failed_ = std::numeric_limits<int>::max();  ///< place of the first failed frame
  std::optional<Error> failure_;
};

}  // namespace

int frames_in_flight(const Sequence& sequence) {
  return static_cast<int>(
      std::min(static_cast<std::size_t>(sequence.in_flight), sequence.frames.size()));
}

void run_steps(const Sequence& sequence, std::span<const FrameStep> steps, Executor& executor) {
  if (!sequence.frames.empty()) Line(sequence, steps).go(executor);
}

}  // namespace limpid

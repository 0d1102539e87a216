#include "limpid/job/sequence.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/job/job_files.h"

#include "job/composite_frame.h"
#include "job/stopwatch.h"
#include "job/water_frame.h"

namespace limpid {
namespace {

/// The frames' way through their slots, and the first failure. Frame i is in slot i % in_flight,
/// which is free by then: that is what Executor::pipeline promises.
class Line {
 public:
  Line(const Sequence& sequence, const std::function<std::unique_ptr<FrameSlot>()>& make_slot,
       Executor& executor)
      : frames_(sequence.frames), executor_(executor) {
    const auto count =
        std::min<std::size_t>(static_cast<std::size_t>(sequence.in_flight), sequence.frames.size());
    while (slots_.size() < count) slots_.push_back(make_slot());
  }

  void go() {
    constexpr Executor::Task kSteps[] = {&step<&Line::begin>, &step<&Line::read>, &step<&Line::run>,
                                         &step<&Line::write>, &step<&Line::done>};
    executor_.pipeline(static_cast<int>(frames_.size()), static_cast<int>(slots_.size()), kSteps,
                       this);
    if (failure_) throw *failure_;
  }

 private:
  void begin(FrameSlot& slot, int index) { slot.begin(frame(index)); }
  void read(FrameSlot& slot, int) { slot.read(executor_); }
  void run(FrameSlot& slot, int) { slot.run(executor_); }
  void write(FrameSlot& slot, int) { slot.write(); }
  void done(FrameSlot& slot, int index) {
    seconds_ += watch_.lap();
    slot.done({frame(index), index + 1, static_cast<int>(frames_.size()), seconds_});
  }

  int frame(int index) const { return frames_[static_cast<std::size_t>(index)]; }

  /// One step of a frame, unless it or one before it has failed.
  template <void (Line::*kStep)(FrameSlot&, int)>
  static void step(void* context, int index) {
    Line& line = *static_cast<Line*>(context);
    if (index >= line.failed_.load()) return;
    FrameSlot& slot = *line.slots_[static_cast<std::size_t>(index) % line.slots_.size()];
    try {
      (line.*kStep)(slot, index);
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
  Executor& executor_;
  std::vector<std::unique_ptr<FrameSlot>> slots_;
  Stopwatch watch_;
  double seconds_ = 0;
  std::mutex mutex_;
  std::atomic<int> failed_ = std::numeric_limits<int>::max();  ///< place of the first that has
  std::optional<Error> failure_;
};

/// A slot whose frames are jobs of composite() or water().
template <class Job, class Work>
class JobSlot : public FrameSlot {
 public:
  JobSlot(const JobOfFrame<Job>& job_of, const OnFrame& on_frame, Work work)
      : job_of_(job_of), on_frame_(on_frame), work_(std::move(work)) {}

  void begin(int frame) override { job_ = job_of_(frame); }
  void read(Executor& executor) override { work_.read(job_, executor); }
  void run(Executor& executor) override { work_.run(job_, executor); }
  void write() override { work_.write(job_); }
  void done(const SequenceProgress& progress) override {
    if (on_frame_) on_frame_(progress, work_.report());
  }

 private:
  const JobOfFrame<Job>& job_of_;
  const OnFrame& on_frame_;
  Job job_;
  Work work_;
};

}  // namespace

void check(const Sequence& sequence) {
  if (sequence.in_flight < 1 || sequence.in_flight > kMostInFlight) {
    throw Error("frames in flight = " + std::to_string(sequence.in_flight) + ": expected 1 ... " +
                    std::to_string(kMostInFlight),
                Fault::kUsage);
  }
}

void run_sequence(const Sequence& sequence,
                  const std::function<std::unique_ptr<FrameSlot>()>& make_slot,
                  Executor& executor) {
  check(sequence);
  if (!sequence.frames.empty()) Line(sequence, make_slot, executor).go();
}

void composite_sequence(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                        const OnFrame& on_frame, Executor& executor) {
  check(sequence);
  expect_apart(sequence.frames, [&](int frame) { return files_of(job_of(frame)); });
  SharedTextures textures;
  const auto make_slot = [&]() -> std::unique_ptr<FrameSlot> {
    return std::make_unique<JobSlot<CompositeJob, CompositeFrame>>(job_of, on_frame,
                                                                   CompositeFrame(textures));
  };
  run_sequence(sequence, make_slot, executor);
}

void render_sequence(const Model& model, const Sequence& sequence,
                     const JobOfFrame<PlateJob>& job_of, const OnFrame& on_frame,
                     Executor& executor) {
  check(sequence);
  expect_apart(sequence.frames, [&](int frame) { return files_of(model, job_of(frame)); });
  const HashedModel hashed(model);
  const auto make_slot = [&]() -> std::unique_ptr<FrameSlot> {
    return std::make_unique<JobSlot<PlateJob, RenderFrame>>(job_of, on_frame, RenderFrame(hashed));
  };
  run_sequence(sequence, make_slot, executor);
}

void water_sequence(const Model& model, const Sequence& sequence,
                    const JobOfFrame<WaterJob>& job_of, const OnFrame& on_frame,
                    Executor& executor) {
  check(sequence);
  expect_apart(sequence.frames, [&](int frame) { return files_of(model, job_of(frame)); });
  SharedTextures textures;
  const HashedModel hashed(model);
  const auto make_slot = [&]() -> std::unique_ptr<FrameSlot> {
    return std::make_unique<JobSlot<WaterJob, WaterFrame>>(job_of, on_frame,
                                                           WaterFrame(hashed, textures));
  };
  run_sequence(sequence, make_slot, executor);
}

}  // namespace limpid

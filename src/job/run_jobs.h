#pragma once
#include <memory>
#include <utility>

#include "limpid/job/resume.h"
#include "limpid/job/sequence.h"

#include "job/frame_faults.h"
#include "job/job_kind.h"
#include "job/resume_frames.h"
#include "job/stopwatch.h"

/// @file
/// One frame, many frames, the rest of many, and their errors, for every kind of job.

namespace limpid {

/// A slot for frames that are jobs of a kind.
template <JobKind Kind>
class JobSlot : public FrameSlot {
 public:
  using Job = typename Kind::Job;
  using Report = typename Kind::Report;

  JobSlot(Kind& kind, const JobOfFrame<Job>& job_of, const OnFrameOf<Report>& on_frame)
      : kind_(kind), job_of_(job_of), on_frame_(on_frame), frame_(kind) {}

  void begin(int frame) override { job_ = job_of_(frame); }
  void read(Executor&) override {
    Stopwatch watch;
    typename Kind::Prepared prepared = kind_.prepare(job_);
    kind_.expect_writable(job_);
    record_ = kind_.record(job_, std::as_const(prepared));
    frame_.report() = {};
    frame_.read(job_, std::move(prepared));
    frame_.report().read_seconds += watch.lap();
  }
  void run(Executor& executor) override {
    Stopwatch watch;
    frame_.run(job_, executor);
    frame_.report().run_seconds += watch.lap();
  }
  void write() override {
    Stopwatch watch;
    frame_.write(job_, std::move(record_));
    frame_.report().write_seconds += watch.lap();
  }
  void done(const SequenceProgress& progress) override {
    if (on_frame_) on_frame_(progress, frame_.report());
  }

 private:
  Kind& kind_;
  const JobOfFrame<Job>& job_of_;
  const OnFrameOf<Report>& on_frame_;
  typename Kind::Frame frame_;
  Job job_;
  Record record_;
};

/// A sequence of one frame, which an Error does not name by number.
template <JobKind Kind>
typename Kind::Report run_job(Kind kind, const typename Kind::Job& job, Executor& executor) {
  typename Kind::Report report;
  const JobOfFrame<typename Kind::Job> job_of = [&](int) { return job; };
  const OnFrameOf<typename Kind::Report> keep = [&](const SequenceProgress&, const auto& made) {
    report = made;
  };
  expect_apart(kind.files(job));
  JobSlot<Kind> slot(kind, job_of, keep);
  slot.begin(0);
  slot.read(executor);
  slot.run(executor);
  slot.write();
  slot.done({});
  return report;
}

template <JobKind Kind>
void run_jobs(Kind kind, const Sequence& sequence, const JobOfFrame<typename Kind::Job>& job_of,
              const OnFrameOf<typename Kind::Report>& on_frame, Executor& executor) {
  expect_apart(sequence.frames, [&](int frame) { return kind.files(job_of(frame)); });
  const auto make_slot = [&]() -> std::unique_ptr<FrameSlot> {
    return std::make_unique<JobSlot<Kind>>(kind, job_of, on_frame);
  };
  run_sequence(sequence, make_slot, executor);
}

template <JobKind Kind>
Rest rest_of_jobs(Kind kind, const Sequence& sequence, const JobOfFrame<typename Kind::Job>& job_of,
                  Executor& executor, VerifyLevel level) {
  const auto output_of = [&](int frame) -> ExpectedOutput {
    auto job = std::make_shared<const typename Kind::Job>(job_of(frame));
    return {kind.files(*job), [&kind, job] { return kind.record(*job, kind.prepare(*job)); }};
  };
  return rest_of_frames(sequence, output_of, executor, level);
}

template <JobKind Kind>
std::vector<FrameFault> faults_of_jobs(Kind kind, const Sequence& sequence,
                                       const JobOfFrame<typename Kind::Job>& job_of,
                                       Executor& executor) {
  expect_apart(sequence.frames, [&](int frame) { return kind.files(job_of(frame)); });
  const auto check_of = [&](int frame) -> std::function<void()> {
    return [&kind, job = job_of(frame), first = frame == sequence.frames.front()] {
      const typename Kind::Prepared prepared = kind.prepare(job);
      kind.expect_writable(job);
      if (first) kind.record(job, prepared);
    };
  };
  return faults_of_frames(sequence, check_of, executor);
}

}  // namespace limpid

#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "limpid/job/composite.h"
#include "limpid/job/water.h"

/// @file
/// Many frames as a pipeline: while one is composited, others are read and written.
/// Each has the same bytes as from composite() or water() alone. job/missing.h handles
/// frames without a plate, job/resume.h frames that exist already: both give a
/// sequence.

namespace limpid {

inline constexpr int kMaxInFlight = 64;

/// The frames of a sequence, and the number of frames in the pipeline.
struct Sequence {
  std::vector<int> frames;  ///< frame numbers, in the order in which they are made
  int in_flight = 3;        ///< 1 ... kMaxInFlight; each frame in flight has its buffers in memory
};
/// The check with which all functions below begin: throws Error of Fault::kUsage for an `in_flight`
/// out of range.
void check(const Sequence& sequence);

/// The progress of a sequence; reported after each frame, in order.
struct SequenceProgress {
  int frame = 0;            ///< the number of the finished frame
  int done = 0, total = 0;  ///< frames
  double seconds = 0;       ///< since the sequence began

  double frames_per_second() const { return seconds > 0 ? done / seconds : 0; }
  double seconds_left() const { return seconds / done * (total - done); }
};

/// Returns the job of a frame. Called for all frames before the first is made, to check that no
/// frame writes a file of another job (job/job_files.h), and then again for each frame, in order,
/// from any thread, one call at a time.
template <class Job>
using JobOfFrame = std::function<Job(int frame)>;
/// Called for each finished frame, in order, from any thread, one call at a time. An exception from
/// it stops the sequence.
template <class Report>
using OnFrameOf = std::function<void(const SequenceProgress&, const Report&)>;
using OnFrame = OnFrameOf<CompositeReport>;

/// Throws Error before any frame is made if two outputs, or an input and an output, are one file.
/// Throws Error, which names the frame, for the first frame (in the order of `frames`) that fails.
/// All frames before it are finished and reported; frames that had not started are skipped, and the
/// output of those that had started is complete or absent. Textures are loaded once.
void composite_sequence(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                        const OnFrame& on_frame, Executor& executor);
void render_sequence(const Model& model, const Sequence& sequence,
                     const JobOfFrame<RenderJob>& job_of, const OnFrame& on_frame,
                     Executor& executor);
void water_sequence(const Model& model, const Sequence& sequence,
                    const JobOfFrame<WaterJob>& job_of, const OnFrame& on_frame,
                    Executor& executor);

/// A slot of the pipeline, which takes one frame at a time through its steps. begin() and done()
/// are called in the order of frames, one slot at a time; the three steps between overlap those of
/// other slots. All steps may throw.
class FrameSlot {
 public:
  virtual ~FrameSlot() = default;
  virtual void begin(int frame) = 0;
  virtual void read(Executor& executor) = 0;
  virtual void run(Executor& executor) = 0;
  virtual void write() = 0;
  virtual void done(const SequenceProgress& progress) = 0;
};

/// The pipeline of the sequences above. `make_slot` is called once for each frame in flight, at
/// most once per frame.
void run_sequence(const Sequence& sequence,
                  const std::function<std::unique_ptr<FrameSlot>()>& make_slot, Executor& executor);

}  // namespace limpid

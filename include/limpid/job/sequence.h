#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "limpid/job/composite.h"
#include "limpid/job/water.h"

/// @file
/// Many frames, one after another, neighbours overlapped: while one is being run, others are read
/// and written. Each gives the same bytes as composite() or water() of it alone. Frames without a
/// plate are a matter of job/missing.h, those that are there already of job/resume.h: both give a
/// sequence.

namespace limpid {

inline constexpr int kMostInFlight = 64;

/// Which frames, and how many of them at once.
struct Sequence {
  std::vector<int> frames;  ///< their numbers, in the order in which they are worked on
  int in_flight = 3;        ///< 1 ... kMostInFlight; each of these holds the buffers of one frame
};
/// Throws the Error that all of the functions below begin with: of Fault::kUsage, for an
/// `in_flight` out of range.
void check(const Sequence& sequence);

/// How far a sequence has come; told after each frame, in order.
struct SequenceProgress {
  int frame = 0;  ///< the number of the one that is done
  int done = 0, of = 0;
  double seconds = 0;  ///< since the sequence began

  double frames_per_second() const { return seconds > 0 ? done / seconds : 0; }
  double seconds_left() const { return seconds / done * (of - done); }
};

/// Asked for the jobs of all frames before the first is made, to see that no frame writes what it
/// or another reads or writes (job/job_files.h), and then again for each when its turn comes: in
/// order, from any thread, one at a time.
template <class Job>
using JobOfFrame = std::function<Job(int frame)>;
/// Called likewise, for frames that are done. What it throws stops the sequence.
template <class Report>
using OnFrameOf = std::function<void(const SequenceProgress&, const Report&)>;
using OnFrame = OnFrameOf<CompositeReport>;

/// Throws Error before anything is made for outputs that are not apart. Throws Error, which names
/// the frame, for the first one (in the order of `frames`) that fails.
/// All before it are done and told of then; of those after it none begins any more, and the few
/// that had begun are whole or not there. What does not change from frame to frame, textures, is
/// loaded once.
void composite_sequence(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                        const OnFrame& on_frame, Executor& executor);
void render_sequence(const Model& model, const Sequence& sequence,
                     const JobOfFrame<RenderJob>& job_of, const OnFrame& on_frame,
                     Executor& executor);
void water_sequence(const Model& model, const Sequence& sequence,
                    const JobOfFrame<WaterJob>& job_of, const OnFrame& on_frame,
                    Executor& executor);

/// The place of one frame in flight, and of others after it: a program's own way to get a frame, to
/// work on it and to hand it on. begin() and done() are called in order, one slot at a time; the
/// three steps between overlap those of other slots. All of them may throw.
class FrameSlot {
 public:
  virtual ~FrameSlot() = default;
  virtual void begin(int frame) = 0;
  virtual void read(Executor& executor) = 0;
  virtual void run(Executor& executor) = 0;
  virtual void write() = 0;
  virtual void done(const SequenceProgress& progress) = 0;
};

/// What the sequences above are made of. `make_slot` is called once for each frame in flight, but
/// no more often than there are frames.
void run_sequence(const Sequence& sequence,
                  const std::function<std::unique_ptr<FrameSlot>()>& make_slot, Executor& executor);

}  // namespace limpid

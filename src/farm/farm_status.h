#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "farm/farm_folder.h"
#include "farm/slurm_text.h"

/// @file
/// Progress of a farm: from its outputs, and from the scheduler's state of its tasks.

namespace limpid {

/// The scheduler's state.
struct FarmQueue {
  std::vector<SlurmTask> tasks;  ///< of the first of FarmRecord::jobs, as far as known
  /// Whether any task of the farm waits, runs, or will start. Nothing if that is not known.
  std::optional<bool> at_work;
  std::string note;  ///< a sentence about a failed query
};

/// A missing frame of a task that neither waits nor runs.
struct FarmFailure {
  std::vector<int> frames;
  std::string sentence;
};

struct FarmStatus {
  std::size_t frames = 0, done = 0;
  /// Over the latest frames, 0 if not known: from the times of their files.
  double frames_per_second = 0;
  std::size_t running = 0, waiting = 0, ended = 0;  ///< tasks known to Slurm
  std::string waits_for;                            ///< reason of the first waiting task
  std::optional<bool> at_work;                      ///< as in FarmQueue
  std::vector<FarmFailure> failed;                  ///< in the order of the chunks
  std::string note;

  bool complete() const { return done == frames; }
};

/// The frames of the chunks that are made: all their files exist, and the picture is not the one
/// that existed before. In the order of the chunks.
std::vector<int> made_frames(const FarmRecord& record, const std::vector<Chunk>& chunks);

/// Frames per second, from the times (in seconds, in any order) of the last 60 frames. 0 for fewer
/// than two.
double rate_of(std::vector<double> times);

FarmStatus status_of(const FarmFolder& folder, const FarmRecord& record, const FarmQueue& queue);

/// Some lines, the first: "117 of 240 frames are done, 3.1 frames/s, 40 s left".
std::string to_text(const FarmStatus& status);

/// The result of the last job: the missing frames, and why some of their files could not be kept.
struct FarmVerdict {
  std::size_t frames = 0;
  std::vector<int> missing;
  std::map<int, std::string> why;
};
/// Some lines: "238 of 240 frames are there and whole, by the hashes that they carry", and then a
/// sentence for each other frame, from the verdict or from its task.
std::string summary_text(const FarmVerdict& verdict, const FarmStatus& status);

}  // namespace limpid

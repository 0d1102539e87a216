#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "farm/farm_folder.h"
#include "farm/slurm_text.h"

/// @file
/// How far a farm is: by its outputs, and by what the scheduler says of its tasks.

namespace limpid {

/// What the scheduler says.
struct FarmQueue {
  std::vector<SlurmTask> tasks;  ///< of the first of FarmRecord::jobs, as far as they are known
  /// Whether anything of the farm waits, runs, or is about to. Nothing where that is not known.
  std::optional<bool> at_work;
  std::string note;  ///< a sentence, of what could not be asked
};

/// Frames that are not there, though no task that would make them waits or runs.
struct FarmFailure {
  std::vector<int> frames;
  std::string sentence;
};

struct FarmStatus {
  std::size_t frames = 0, done = 0;
  /// Of the frames that were made last, 0 where it is not known: by the times of their files.
  double frames_per_second = 0;
  std::size_t running = 0, waiting = 0, ended = 0;  ///< tasks that Slurm knows
  std::string waits_for;                            ///< reason of the first task that waits
  std::optional<bool> at_work;                      ///< as FarmQueue has it
  std::vector<FarmFailure> failed;                  ///< in the order of the chunks
  std::string note;

  bool complete() const { return done == frames; }
};

/// Which frames of the chunks are made: all files of theirs are there, and the picture is not what
/// was there before. In the order of the chunks.
std::vector<int> made_frames(const FarmRecord& record, const std::vector<Chunk>& chunks);

/// Frames a second, by the times (in seconds, in any order) at which they were made: of the last
/// 60. 0 for less than two.
double rate_of(std::vector<double> times);

FarmStatus status_of(const FarmFolder& folder, const FarmRecord& record, const FarmQueue& queue);

/// Some lines, the first: "117 of 240 frames are done, 3.1 frames/s, 40 s left".
std::string to_text(const FarmStatus& status);

/// Of one that has been looked at as a whole: which frames were found missing, and why not all of
/// the files of some of these could be kept.
struct FarmVerdict {
  std::size_t frames = 0;
  std::vector<int> missing;
  std::map<int, std::string> why;
};
/// Some lines: "238 of 240 frames are there and whole, by the hashes that they carry", and then a
/// sentence for each that is not, from the verdict or from what the tasks said of it.
std::string summary_text(const FarmVerdict& verdict, const FarmStatus& status);

}  // namespace limpid

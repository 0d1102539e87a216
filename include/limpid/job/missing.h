#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "limpid/job/sequence.h"

/// @file
/// Sequences with missing frames: frames without a plate.

namespace limpid {

enum class Missing {
  kError,  ///< the frame is an error when its turn comes
  kSkip,   ///< the frame is left out
  /// The inputs (plate, scene, kind of depth) of the nearest earlier frame with a plate are used,
  /// or if there is none, those of the first later one; outputs, look and time are the frame's own.
  /// If the plate has its own time, that is shifted by the difference of the two frames'
  /// JobTime::otherwise.
  kHold,
};

/// A frame with a missing file.
struct MissingPlate {
  int frame;
  std::filesystem::path file;   ///< the first missing one
  std::optional<int> stand_in;  ///< the frame whose inputs it uses
};

struct FilledSequence {
  std::vector<int> frames;          ///< frames to make, in the order of the sequence
  JobOfFrame<CompositeJob> job_of;  ///< of these frames
  std::vector<MissingPlate> missing;
};

/// The first missing file of the job's plate.
std::optional<std::filesystem::path> missing_file(const CompositeJob& job);

/// Checks once which files of all frames exist (files_of() of their plates; nothing is opened) and
/// decides about frames with missing ones. A file that exists but cannot be read is not missing: it
/// stays an error, like any other fault of a frame, when its turn comes. A file that has
/// disappeared by then is an Error of Fault::kRetry. With kError nothing is checked. `job_of` may
/// be called for the same frame more than once. Throws Error if no frame has a plate.
FilledSequence fill_missing(const std::vector<int>& frames, const JobOfFrame<CompositeJob>& job_of,
                            Missing missing);

}  // namespace limpid

#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "limpid/job/sequence.h"

/// @file
/// Sequences with holes: frames whose plate is not there.

namespace limpid {

enum class Missing {
  kError,  ///< such a frame is an error when its turn comes
  kSkip,   ///< it is left out
  /// The inputs (plate, scene, kind of depth) of the nearest frame before it that is there stand
  /// in, or where there is none, of the first one after it; outputs, look and time are its own. A
  /// plate that tells its own time is taken to be as much younger as the two frames'
  /// JobTime::otherwise are apart.
  kHold,
};

/// A frame with a file that is not there.
struct MissingPlate {
  int frame;
  std::filesystem::path file;   ///< the first such
  std::optional<int> stand_in;  ///< whose inputs it gets
};

struct FilledSequence {
  std::vector<int> frames;          ///< to be made, in the order of the sequence
  JobOfFrame<CompositeJob> job_of;  ///< of these frames
  std::vector<MissingPlate> missing;
};

/// The first file of the job's plate that is not there.
std::optional<std::filesystem::path> missing_file(const CompositeJob& job);

/// Looks, once, which files of all frames are there (files_of() of their plates; nothing is opened)
/// and decides what becomes of the others. A file that is there but cannot be read is none that is
/// missing: it stays an error, as does anything else that is wrong with a frame, when its turn
/// comes. A file that was there now and is gone then is an Error of Fault::kRetry. With kError
/// nothing is looked at. `job_of` may be asked for the same frame more than once. Throws Error when
/// no frame of all is there.
FilledSequence fill_missing(const std::vector<int>& frames, const JobOfFrame<CompositeJob>& job_of,
                            Missing missing);

}  // namespace limpid

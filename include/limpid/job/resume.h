#pragma once
#include <string>
#include <vector>

#include "limpid/job/sequence.h"

/// @file
/// Resuming a sequence that was interrupted: finds the frames that exist already.

namespace limpid {

/// The rest of a sequence.
struct Rest {
  std::vector<int> frames;  ///< frames to make, in the order of the sequence
  int kept = 0;             ///< number of the other frames, which exist and are kept

  struct Other {
    int frame;
    std::string why;  ///< "wet.0007.exr was made differently (look)"
  };
  std::vector<Other> others;  ///< those of `frames` whose picture exists, but cannot be kept
};

/// The check of the files of a frame.
enum class VerifyLevel {
  /// Headers and completeness: finds a truncated or replaced file, but not a changed byte among the
  /// pixels of an EXR. The checksums of PNGs are checked.
  kWhole,
  /// Also all bytes, by the hash in each EXR (ExrFile::is_as_written): finds any byte that has
  /// changed since the file was written. Reads all existing files.
  kContents,
};

/// A frame is kept if all of its files exist, are complete, and have the same records
/// (job/output.h) as if they were made now: this version, inputs with the same contents, the same
/// look, plan and options. A preview other than a PNG has no record, so its frame is never kept.
/// Inputs are checked only for frames with an existing picture: headers are read, bytes hashed, no
/// pixel is decoded. A fault of a frame's inputs is no error here, but an error when its turn
/// comes. Removes leftover temporary files (files/unfinished.h) from the folders of all outputs.
/// Throws Error as the sequences do, first of all for outputs that are also inputs or other
/// outputs.
Rest rest_of_composite(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                       Executor& executor, VerifyLevel level = VerifyLevel::kWhole);
Rest rest_of_render(const Model& model, const Sequence& sequence,
                    const JobOfFrame<RenderJob>& job_of, Executor& executor,
                    VerifyLevel level = VerifyLevel::kWhole);
Rest rest_of_water(const Model& model, const Sequence& sequence, const JobOfFrame<WaterJob>& job_of,
                   Executor& executor, VerifyLevel level = VerifyLevel::kWhole);

}  // namespace limpid

#pragma once
#include <string>
#include <vector>

#include "limpid/job/sequence.h"

/// @file
/// Going on with a sequence where another run of it stopped, for whatever reason: which of its
/// frames are there already.

namespace limpid {

/// What is left to do of a sequence.
struct Rest {
  std::vector<int> frames;  ///< to be made, in the order of the sequence
  int kept = 0;             ///< how many others are there and are left alone

  struct Other {
    int frame;
    std::string why;  ///< "wet.0007.exr was made otherwise (look)"
  };
  std::vector<Other> others;  ///< those of `frames` whose picture is there, but cannot be kept
};

/// How closely the files of a frame are looked at.
enum class Scrutiny {
  /// Headers, and whether all pixels are there: sees a file that was cut off or is another one, not
  /// a byte that has changed among the pixels of an EXR. PNGs have checksums, which are looked at.
  kWhole,
  /// All bytes besides, by the hash that each EXR carries (ExrFile::is_as_written): sees any byte
  /// that has changed since the file was written. Reads all files that are there.
  kContents,
};

/// A frame is kept when all of its files are there, are whole, and say of themselves (job/output.h)
/// exactly what they would say if they were made now: by this version, from inputs of the same
/// contents, with the same look, plan and options. A preview other than a PNG cannot say it, so its
/// frame is never kept. Inputs are looked at for frames alone whose picture is there: headers are
/// read, bytes hashed, no pixel is decoded. What is wrong with a frame's inputs is no error here,
/// but when its turn comes. Removes abandoned temporary files (files/unfinished.h) from the folders
/// of all outputs. Throws Error as the sequences do: first of all for outputs that are not apart.
Rest rest_of_composite(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                       Executor& executor, Scrutiny scrutiny = Scrutiny::kWhole);
Rest rest_of_render(const Model& model, const Sequence& sequence,
                    const JobOfFrame<RenderJob>& job_of, Executor& executor,
                    Scrutiny scrutiny = Scrutiny::kWhole);
Rest rest_of_water(const Model& model, const Sequence& sequence, const JobOfFrame<WaterJob>& job_of,
                   Executor& executor, Scrutiny scrutiny = Scrutiny::kWhole);

}  // namespace limpid

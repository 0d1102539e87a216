#pragma once
#include <string>
#include <vector>

#include "limpid/sequence.h"

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

/// A frame is kept when all of its files are there, are whole, and say of themselves (output.h)
/// exactly what they would say if they were made now: by this version, from inputs of the same
/// contents, with the same look, plan and options. A preview other than a PNG cannot say it, so its
/// frame is never kept. Inputs are looked at for frames alone whose picture is there: headers are
/// read, bytes hashed, no pixel is decoded. What is wrong with a frame's inputs is no error here,
/// but when its turn comes. Removes abandoned temporary files (write/unfinished.h) from the folders
/// of all outputs. Throws Error as the sequences do: first of all for outputs that are not apart.
Rest rest_of_composite(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                       Executor& executor);
Rest rest_of_render(const Model& model, const Sequence& sequence,
                    const JobOfFrame<PlateJob>& job_of, Executor& executor);
Rest rest_of_water(const Model& model, const Sequence& sequence, const JobOfFrame<WaterJob>& job_of,
                   Executor& executor);

}  // namespace limpid

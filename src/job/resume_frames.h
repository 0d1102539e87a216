#pragma once
#include <functional>

#include "limpid/job/job_files.h"
#include "limpid/job/resume.h"

#include "job/provenance.h"

namespace limpid {

/// What a frame's job would write, whatever its kind.
struct ExpectedOutput {
  JobFiles files;                  ///< the outputs' picture first
  std::function<Record()> record;  ///< throws Error as the job would
};

/// What is left to do of a sequence (job/resume.h). `output_of` is asked as JobOfFrame is.
Rest rest_of_frames(const Sequence& sequence,
                    const std::function<ExpectedOutput(int frame)>& output_of, Executor& executor,
                    VerifyLevel level);

}  // namespace limpid

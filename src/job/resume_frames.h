#pragma once
#include <functional>

#include "limpid/job/job_files.h"
#include "limpid/job/resume.h"

#include "job/provenance.h"

namespace limpid {

/// The output of a frame's job, for any kind.
struct ExpectedOutput {
  JobFiles files;                  ///< the outputs' picture first
  std::function<Record()> record;  ///< throws Error as the job would
};

/// The rest of a sequence (job/resume.h). `output_of` is called like JobOfFrame.
Rest rest_of_frames(const Sequence& sequence,
                    const std::function<ExpectedOutput(int frame)>& output_of, Executor& executor,
                    VerifyLevel level);

}  // namespace limpid

#pragma once
#include <cstddef>
#include <string>

#include "limpid/core/executor.h"
#include "limpid/job/resume.h"

#include "arguments.h"
#include "farm/farm_folder.h"
#include "farm/farm_status.h"
#include "farm_work.h"

/// The work of `limpid farm` before and after its tasks.

namespace limpid::tool {

/// Throws the Error of the first frame that cannot be made, with the number of others.
void expect_sound(const FarmWork& work, Executor& executor);

/// The rest of the frames, which is reported.
Rest rest_of(const FarmWork& work, const CommonArguments& common, Executor& executor);

/// A farm ready for submission.
struct Submission {
  FarmWork work;
  FarmFolder folder;
  FarmRecord record;
  std::string chunks, task, verify;   ///< texts of its files
  std::size_t frames = 0, tasks = 0;  ///< to be made; 0 if the measured frame was the last

  /// All files, each after its name.
  std::string text() const;
  /// Writes the files into the folder, replacing those of an earlier submission.
  void write() const;
};

/// Splits the remaining frames into tasks, at most as many as allowed. Without --chunk, makes and
/// measures one frame here first.
Submission prepare(const FarmArguments& arguments, const FarmWork& work, const FarmFolder& folder,
                   const Rest& rest, std::size_t most_tasks, const CommonArguments& common);

/// Verifies every byte of all frames; writes and returns the summary, a single line if all are
/// valid.
std::string summarise(const FarmFolder& folder, const FarmWork& work, const FarmStatus& status,
                      Executor& executor);

}  // namespace limpid::tool

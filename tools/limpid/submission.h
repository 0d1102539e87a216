#pragma once
#include <cstddef>
#include <string>

#include "limpid/core/executor.h"
#include "limpid/job/resume.h"

#include "arguments.h"
#include "farm/farm_folder.h"
#include "farm/farm_status.h"
#include "farm_work.h"

/// What `limpid farm` does before and after its tasks.

namespace limpid::tool {

/// Throws the Error of the first frame that could not be made, and says how many others there are.
void expect_sound(const FarmWork& work, Executor& executor);

/// What is left to do, which is told.
Rest rest_of(const FarmWork& work, const CommonArguments& common, Executor& executor);

/// A farm that is ready: all but its jobs.
struct Submission {
  FarmWork work;
  FarmFolder folder;
  FarmRecord record;
  std::string chunks, task, verify;   ///< texts of its files
  std::size_t frames = 0, tasks = 0;  ///< to be made; none where the frame made first was all

  /// All files, each with its name before it.
  std::string text() const;
  /// Into the folder, in place of those of the submission before.
  void write() const;
};

/// Cuts what is left into tasks, so many at most. Without --chunk, one frame of it is made first,
/// here, and measured.
Submission prepare(const FarmArguments& arguments, const FarmWork& work, const FarmFolder& folder,
                   const Rest& rest, std::size_t most_tasks, const CommonArguments& common);

/// Looks at every byte of all frames, and writes and returns the summary: one line where all is
/// well.
std::string summarise(const FarmFolder& folder, const FarmWork& work, const FarmStatus& status,
                      Executor& executor);

}  // namespace limpid::tool

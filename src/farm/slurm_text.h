#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Parses the output of Slurm's programs.

namespace limpid {

/// A task of an array, or a single job.
struct SlurmTask {
  long job = 0;        ///< number of the job or of the array
  int task = 0;        ///< number in the array, or 0
  std::string state;   ///< PENDING, RUNNING, COMPLETED, FAILED, TIMEOUT ...
  std::string reason;  ///< why it waits, or how it ended; or ""
  std::string node;    ///< its node, or ""

  bool operator==(const SlurmTask&) const = default;
};

/// Whether a task in that state has ended: a task that has not may not be started elsewhere. An
/// unknown state, of a later Slurm, counts as not ended.
bool is_over(std::string_view state);
bool is_running(std::string_view state);

/// squeue's output with --array --noheader and this format.
inline constexpr const char* kSqueueFormat = "%F|%K|%T|%r|%N";
/// Throws Error for a malformed line.
std::vector<SlurmTask> tasks_of_squeue(std::string_view text);

/// sacct's output with --noheader --parsable2 and this format; steps are skipped, and tasks that
/// wait together, as "12_[5-9]", are not listed.
inline constexpr const char* kSacctFormat = "JobID,State,ExitCode,NodeList";
/// Throws Error for a malformed line.
std::vector<SlurmTask> tasks_of_sacct(std::string_view text);

/// The number of the job in the output of `sbatch --parsable`. Throws Error.
long job_of_sbatch(std::string_view text);

/// The most tasks of an array, in the output of `scontrol show config`.
std::optional<int> most_tasks_of(std::string_view config);

}  // namespace limpid

#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// What Slurm's programs print, taken apart.

namespace limpid {

/// A task of an array, or a job that is none.
struct SlurmTask {
  long job = 0;        ///< number of the job, of an array the array's
  int task = 0;        ///< number in the array, or 0
  std::string state;   ///< PENDING, RUNNING, COMPLETED, FAILED, TIMEOUT ...
  std::string reason;  ///< why it waits, or how it ended; or ""
  std::string node;    ///< where it runs or ran, or ""

  bool operator==(const SlurmTask&) const = default;
};

/// Whether a task in that state waits, runs, or is about to: nothing of it may be begun elsewhere.
/// A state of a later Slurm counts as one that is not over.
bool is_over(std::string_view state);
bool is_running(std::string_view state);

/// What squeue prints of --array --noheader with this format.
inline constexpr const char* kSqueueFormat = "%F|%K|%T|%r|%N";
/// Throws Error for a line of another form.
std::vector<SlurmTask> tasks_of_squeue(std::string_view text);

/// What sacct prints of --noheader --parsable2 with this format; steps are left out, and of tasks
/// that wait together, as "12_[5-9]", there is none.
inline constexpr const char* kSacctFormat = "JobID,State,ExitCode,NodeList";
/// Throws Error for a line of another form.
std::vector<SlurmTask> tasks_of_sacct(std::string_view text);

/// The number of the job that `sbatch --parsable` has submitted. Throws Error.
long job_of_sbatch(std::string_view text);

/// The most tasks of an array, of what `scontrol show config` prints.
std::optional<int> most_tasks_of(std::string_view config);

}  // namespace limpid

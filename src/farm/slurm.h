#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "farm/farm_folder.h"
#include "farm/farm_status.h"

/// @file
/// Slurm, by its programs sbatch, squeue, sacct, scancel and scontrol.

namespace limpid {

/// The most tasks of one job on this cluster, or Slurm's default. Throws Error without Slurm.
std::size_t most_slurm_tasks();

/// Submits the scripts of the folder: task.sh, and verify.sh to follow when all tasks have ended.
/// Returns their job numbers. If the second is refused, cancels the first. Throws Error, of
/// Fault::kRetry if Slurm does not respond.
std::vector<long> submit(const FarmFolder& folder);

/// The state of jobs from squeue, and from sacct if there is accounting. Throws nothing: a note
/// names a failed query.
FarmQueue queue_of(const std::vector<long>& jobs);

/// Removes the jobs from the queue and ends their running tasks. Throws Error.
void cancel(const std::vector<long>& jobs);

}  // namespace limpid

#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "farm/farm_folder.h"
#include "farm/farm_status.h"

/// @file
/// Slurm, by its programs sbatch, squeue, sacct, scancel and scontrol.

namespace limpid {

/// The most tasks of one job here, or what Slurm has where nothing else is set. Throws Error where
/// there is no Slurm.
std::size_t most_slurm_tasks();

/// Submits the scripts of the folder: task.sh, and verify.sh to follow when all tasks have ended.
/// Returns their jobs' numbers. Where the second is refused, the first is taken back. Throws Error,
/// of Fault::kRetry where Slurm does not answer.
std::vector<long> submit(const FarmFolder& folder);

/// What squeue, and sacct where there is accounting, say of jobs. Throws nothing: a note tells what
/// could not be asked.
FarmQueue queue_of(const std::vector<long>& jobs);

/// Takes the jobs from the queue and ends what runs of them. Throws Error.
void cancel(const std::vector<long>& jobs);

}  // namespace limpid

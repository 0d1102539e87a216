#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "farm/farm_folder.h"

/// @file
/// The tasks of a farm on this machine, without a scheduler.

namespace limpid {

/// Runs task.sh of the folder for the tasks 1 ... `tasks`, each once, `at_once` of them at a time.
/// Calls `on_end` for each task that has ended, one at a time. Returns once all have ended. Throws
/// Error if bash cannot be started, and after stop_programs().
void run_tasks(const FarmFolder& folder, std::size_t tasks, int at_once,
               const std::function<void()>& on_end);

}  // namespace limpid

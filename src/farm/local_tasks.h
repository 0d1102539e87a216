#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "farm/farm_folder.h"

/// @file
/// The tasks of a farm on this machine, where there is no scheduler.

namespace limpid {

/// Runs task.sh of the folder for the tasks 1 ... `tasks`, each once, `at_once` of them at a time.
/// `on_end` hears of each that has ended, one at a time. Returns once all have ended. Throws Error
/// where bash cannot be started, and when stop_programs() was called.
void run_tasks(const FarmFolder& folder, std::size_t tasks, int at_once,
               const std::function<void()>& on_end);

}  // namespace limpid

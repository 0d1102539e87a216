#pragma once
#include <mutex>

namespace limpid {

/// Removes the temporary files of everything that is being written in this process. While the lock
/// that comes back is held, no other begins and none is renamed: a program that a signal tells to
/// stop holds it until it has ended. Takes locks and memory, so call it from a thread that waits
/// for signals, not from a signal handler.
[[nodiscard]] std::unique_lock<std::mutex> remove_unfinished_files();

}  // namespace limpid

#pragma once
#include <filesystem>
#include <mutex>

namespace limpid {

/// Removes the temporary files of everything that is being written in this process. While the lock
/// that comes back is held, no other begins and none is renamed: a program that a signal tells to
/// stop holds it until it has ended. Takes locks and memory, so call it from a thread that waits
/// for signals, not from a signal handler.
[[nodiscard]] std::unique_lock<std::mutex> remove_unfinished_files();

/// Removes from a folder the temporary files of processes that are no more, as one killed by
/// SIGKILL leaves them: those with a name like theirs that nobody holds locked. Files that are
/// being written stay, whichever process or machine writes them, and so does everything where the
/// file system has no locks. Throws nothing; a folder that is not there has none. Whatever writes a
/// file through this library calls it once for its folder.
void remove_abandoned_files(const std::filesystem::path& folder);

}  // namespace limpid

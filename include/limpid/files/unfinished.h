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
/// being written stay, whichever process writes them. On file systems that other machines may share
/// (NFS, SMB, FUSE, and all that is not known to be local: ext2 ... ext4, XFS, Btrfs, F2FS, ZFS,
/// bcachefs, ReiserFS, NILFS, FAT, exFAT, tmpfs, overlay) nothing is locked and nothing removed: a
/// lock may not reach the other machine. Throws nothing; a folder that is not there has none.
/// Whatever writes a file through this library calls it once for its folder.
void remove_abandoned_files(const std::filesystem::path& folder);

}  // namespace limpid

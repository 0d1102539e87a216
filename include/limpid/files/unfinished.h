#pragma once
#include <filesystem>
#include <mutex>

namespace limpid {

/// Removes the temporary files of all writes in progress in this process. While the returned lock
/// is held, no write starts and no file is renamed: a program that a signal stops holds the lock
/// until it exits. Takes locks and allocates memory, so call it from a thread that waits for
/// signals, not from a signal handler.
[[nodiscard]] std::unique_lock<std::mutex> remove_unfinished_files();

/// Removes leftover temporary files of dead processes, such as after SIGKILL, from a folder: files
/// with the name of a temporary file that no process has locked. Files that a process is writing
/// stay. On file systems that other machines may share (NFS, SMB, FUSE, and all that are not known
/// to be local: ext2 ... ext4, XFS, Btrfs, F2FS, ZFS, bcachefs, ReiserFS, NILFS, FAT, exFAT, tmpfs,
/// overlay) no file is locked and none removed, since other machines may not see a lock. Throws
/// nothing, also for a missing folder. All writers of this library call it once for their folder.
void remove_abandoned_files(const std::filesystem::path& folder);

}  // namespace limpid

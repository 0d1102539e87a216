#pragma once

namespace limpid {

/// Whether the descriptor is open on a local file system, where all users of the file see its lock
/// (flock), and the lock prevents no writing. Only known types count: on SMB, locks block other
/// descriptors of the same process; on NFS and FUSE they may end at this machine while other
/// machines write.
bool is_local(int descriptor);

/// The same for a type of statfs(2).
bool is_local_type(unsigned long type);

}  // namespace limpid

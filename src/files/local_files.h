#pragma once

namespace limpid {

/// Whether the descriptor is open on a file system of this machine, where a lock (flock) is seen by
/// all who see the file and keeps nobody from writing. Only what is known to be one is: on SMB,
/// locks shut out other descriptors of the same process; on NFS and FUSE they may end at this
/// machine while others write.
bool is_local(int descriptor);

/// The same by a type of statfs(2).
bool is_local_type(unsigned long type);

}  // namespace limpid

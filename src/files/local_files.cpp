#include "files/local_files.h"

#include <algorithm>
#include <iterator>

#include <linux/magic.h>
#include <sys/vfs.h>

namespace limpid {
namespace {

// Some are missing in <linux/magic.h>.
constexpr unsigned long kBcachefs = 0xca451a4e, kExfat = 0x2011bab0, kZfs = 0x2fc12fc1;

constexpr unsigned long kLocal[] = {
    EXT4_SUPER_MAGIC,  // and ext2, ext3
    XFS_SUPER_MAGIC,  BTRFS_SUPER_MAGIC,    F2FS_SUPER_MAGIC,      kZfs,
    kBcachefs,        REISERFS_SUPER_MAGIC, NILFS_SUPER_MAGIC,     MSDOS_SUPER_MAGIC,
    kExfat,           TMPFS_MAGIC,          OVERLAYFS_SUPER_MAGIC,
};

}  // namespace

bool is_local_type(unsigned long type) {
  return std::find(std::begin(kLocal), std::end(kLocal), type) != std::end(kLocal);
}

bool is_local(int descriptor) {
  struct statfs status {};
  // Types are 32 bits, which a signed long extends.
  return ::fstatfs(descriptor, &status) == 0 &&
         is_local_type(static_cast<unsigned long>(status.f_type) & 0xffffffffUL);
}

}  // namespace limpid

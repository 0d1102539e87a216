#include "fuzz/memory_file.h"

#include <cerrno>
#include <system_error>

#include <sys/mman.h>
#include <unistd.h>

namespace limpid::fuzz {
namespace {

void expect_done(bool done, const char* what) {
  if (!done) throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

MemoryFile::MemoryFile() : descriptor_(::memfd_create("limpid", MFD_CLOEXEC)) {
  expect_done(descriptor_ >= 0, "memfd_create");
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

void MemoryFile::hold(Bytes bytes) {
  expect_done(::ftruncate(descriptor_, 0) == 0, "ftruncate");
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written =
        ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    expect_done(written > 0, "pwrite");
    done += static_cast<std::size_t>(written);
  }
}

}  // namespace limpid::fuzz

#include "fuzz/harness.h"
#include "fuzz/memory_file.h"
#include "fuzz/read_exr.h"

namespace limpid::fuzz {
namespace {

/// Small, so that the allocation before the reader finds pixels missing costs no time.
Limits small_limits() {
  Limits limits;
  limits.max_pixels = 1 << 18;
  limits.max_side = 4096;
  limits.max_channels = 64;
  limits.max_parts = 16;
  limits.max_memory = 64 << 20;
  limits.max_samples = 1 << 18;
  return limits;
}

}  // namespace

void exr(Bytes bytes) {
  static MemoryFile file;
  file.hold(bytes);
  accepts([&] { read_exr(file.path(), small_limits()); });
}

}  // namespace limpid::fuzz

#include "core/memory.h"

#include <sys/mman.h>

namespace limpid {
namespace {

bool can_map(std::size_t bytes, int protection) {
  void* const block = ::mmap(nullptr, bytes, protection, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (block == MAP_FAILED) return false;
  ::munmap(block, bytes);
  return true;
}

}  // namespace

bool has_memory(std::size_t bytes) { return can_map(bytes, PROT_READ | PROT_WRITE); }

bool has_addresses(std::size_t bytes) { return can_map(bytes, PROT_NONE); }

}  // namespace limpid

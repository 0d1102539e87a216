// A separate program: it replaces every operator new of the program, and the linker leads calls of
// calloc() to __wrap_calloc() (-Wl,--wrap), to count allocations.
#include "allocations/count.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {
std::atomic<int> count = 0;
std::atomic<bool> none_left = false;

void* counted(std::size_t size, std::size_t alignment) {
  ++count;
  if (none_left) throw std::bad_alloc();
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  if (void* p = std::aligned_alloc(alignment, whole == 0 ? alignment : whole)) return p;
  throw std::bad_alloc();
}
}  // namespace

// No function of a pair is inlined: where only one is inlined, GCC takes free() for a mistake.
#define LIMPID_COUNTED __attribute__((noinline))
LIMPID_COUNTED void* operator new(std::size_t size) {
  return counted(size, alignof(std::max_align_t));
}
LIMPID_COUNTED void* operator new[](std::size_t size) {
  return counted(size, alignof(std::max_align_t));
}
LIMPID_COUNTED void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return counted(size, alignof(std::max_align_t));
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
LIMPID_COUNTED void* operator new(std::size_t size, std::align_val_t a) {
  return counted(size, static_cast<std::size_t>(a));
}
LIMPID_COUNTED void* operator new[](std::size_t size, std::align_val_t a) {
  return counted(size, static_cast<std::size_t>(a));
}
LIMPID_COUNTED void operator delete(void* p) noexcept { std::free(p); }
LIMPID_COUNTED void operator delete[](void* p) noexcept { std::free(p); }
LIMPID_COUNTED void operator delete(void* p, std::size_t) noexcept { std::free(p); }
LIMPID_COUNTED void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
LIMPID_COUNTED void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
LIMPID_COUNTED void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
LIMPID_COUNTED void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
LIMPID_COUNTED void operator delete[](void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}

extern "C" void* __real_calloc(std::size_t number, std::size_t size);
extern "C" void* __wrap_calloc(std::size_t number, std::size_t size) {
  ++count;
  return __real_calloc(number, size);
}

int limpid::test::allocations() { return count; }

limpid::test::NoMemory::NoMemory() { none_left = true; }
limpid::test::NoMemory::~NoMemory() { none_left = false; }

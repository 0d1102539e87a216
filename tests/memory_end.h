#pragma once
#include <cstdlib>
#include <fstream>
#include <vector>

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

/// Lets memory come to an end in a process of its own, as EXPECT_EXIT starts. Not with sanitizers.

namespace limpid::test {

/// The system gives this process at most this many more bytes of addresses.
inline void limit_addresses(std::size_t more) {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages;
  rlimit limit{};
  ::getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + more;
  ::setrlimit(RLIMIT_AS, &limit);
}

/// Leaves room for small allocations, such as the text of an Error, and for no allocation of 1 KiB
/// or more.
inline void exhaust_memory() {
  limit_addresses(0);
  constexpr std::size_t kSmall = 512, kRooms = 1000;
  for (std::size_t size = std::size_t{1} << 20; size > kSmall; size /= 2) {
    while (std::malloc(size) != nullptr) continue;
  }
  void* rooms[2 * kRooms];
  std::size_t count = 0;
  while (count < 2 * kRooms && (rooms[count] = std::malloc(kSmall)) != nullptr) ++count;
  for (std::size_t i = 0; i < count; i += 2) std::free(rooms[i]);
}

/// No thread can be started any more: its stack would be larger than the memory that is left.
inline void make_threads_impossible() {
  constexpr std::size_t kGibibyte = std::size_t{1} << 30;
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, 4 * kGibibyte);
  ::pthread_setattr_default_np(&attributes);
  ::pthread_attr_destroy(&attributes);
  limit_addresses(kGibibyte);
}

}  // namespace limpid::test

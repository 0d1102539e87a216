#include "memory_limit.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>

#include <malloc.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include "limpid/core/error.h"

namespace limpid::tool {
namespace {

constexpr std::int64_t kLeast = std::int64_t{16} << 20;
constexpr std::size_t kStackBytes = std::size_t{1} << 20;

/// Bytes of this process that RLIMIT_DATA counts: the sixth number of /proc/self/statm, in pages.
std::int64_t data_bytes() {
  std::ifstream file("/proc/self/statm");
  std::int64_t pages = 0;
  for (int field = 0; field < 6; ++field) file >> pages;
  if (!file) throw Error("--max-memory: /proc/self/statm cannot be read");
  return pages * ::sysconf(_SC_PAGESIZE);
}

}  // namespace

std::int64_t memory_named(const std::string& text) {
  constexpr std::string_view kUnits = "KMGT";
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number, std::chars_format::fixed);
  std::size_t unit = 0;
  const char* rest = read.ptr;
  if (rest != end) unit = kUnits.find(*rest++) + 1;  // 0 for another letter
  const bool good = read.ec == std::errc() && rest == end && (read.ptr == end || unit > 0);
  const double bytes = std::ldexp(number, 10 * static_cast<int>(unit));
  if (!good || !(bytes >= static_cast<double>(kLeast)) || bytes > 0x1p62) {
    throw Error(
        "--max-memory " + text + ": expected bytes, or as in 512M or 1.5G, from 16M up to 4194304T",
        Fault::kUsage);
  }
  return static_cast<std::int64_t>(bytes);
}

Limits limits_of(const CommonArguments& common) {
  Limits limits;
  if (common.max_memory) limits.max_memory = memory_named(*common.max_memory);
  return limits;
}

void make_threads_small() {
  // glibc's default is 8 MiB each, which count even if unused.
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, kStackBytes);
  ::pthread_setattr_default_np(&attributes);
  ::pthread_attr_destroy(&attributes);
  // And a heap of 64 MiB, which counts if addresses are limited.
  rlimit addresses{};
  ::getrlimit(RLIMIT_AS, &addresses);
  if (addresses.rlim_cur != RLIM_INFINITY) ::mallopt(M_ARENA_MAX, 1);
}

void share_heap() { ::mallopt(M_ARENA_MAX, 1); }

void limit_process(const CommonArguments& common) {
  if (!common.max_memory) return;
  const std::int64_t wanted = memory_named(*common.max_memory);
  rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  const auto most = static_cast<rlim_t>(data_bytes() + wanted);
  limit.rlim_cur = std::min(limit.rlim_max, most);
  if (::setrlimit(RLIMIT_DATA, &limit) != 0) {
    throw Error(std::string("--max-memory: the system sets no limit (") + std::strerror(errno) +
                ")");
  }
}

}  // namespace limpid::tool

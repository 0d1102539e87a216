#include "files/picture/formats.h"

#include <filesystem>

#include "limpid/core/error.h"

#include "core/memory.h"
#include "core/threads.h"
#include "files/module_file.h"

namespace limpid::formats {
namespace {

namespace fs = std::filesystem;

/// Libraries of OpenImageIO 2.4 crash as they are loaded where memory or threads end: log4cplus,
/// which comes with them, begins four threads. With all that a first picture of 960x540 needs, they
/// were seen to take 76 MiB beside the stacks, and 437 MiB of addresses in all.
void expect_room(const std::string& wanted_for) {
  constexpr int kThreads = 4;
  constexpr std::size_t kBytes = std::size_t{80} << 20, kAddresses = std::size_t{448} << 20;
  const std::size_t stack = usual_stack_bytes();
  if (!has_addresses(kAddresses) || !has_memory(kBytes + kThreads * stack)) {
    throw no_memory(wanted_for);
  }
  if (threads_to_be_had(kThreads, stack) < kThreads) {
    throw Error(
        wanted_for +
            ": formats other than EXR, PNG and JPEG need four threads more than can be made",
        Fault::kRetry);
  }
}

Module load(const fs::path& path, const std::string& wanted_for) {
  expect_room(wanted_for);
  void* library = open_module(path, "format", kFormatsAbi);
  return {reinterpret_cast<decltype(&limpid_formats_read)>(
              module_function(library, path, "limpid_formats_read")),
          reinterpret_cast<decltype(&limpid_formats_write8)>(
              module_function(library, path, "limpid_formats_write8"))};
}

Module find(const std::string& wanted_for) {
  const std::string needs = wanted_for + ": formats other than EXR, PNG and JPEG need";
  return load(module_file("limpid_formats.so", needs), wanted_for);
}

}  // namespace

const Module& module(const std::string& wanted_for) {
  static const Module loaded = find(wanted_for);
  return loaded;
}

}  // namespace limpid::formats

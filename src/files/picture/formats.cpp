#include "files/picture/formats.h"

#include <filesystem>

#include "limpid/core/error.h"

#include "core/memory.h"
#include "core/threads.h"
#include "files/module_file.h"

namespace limpid::formats {
namespace {

namespace fs = std::filesystem;

/// OpenImageIO 2.4's libraries crash on loading if memory or threads run out: log4cplus, one of
/// them, starts four threads. With all that a first picture of 960x540 needs, 76 MiB besides the
/// stacks were measured, and 437 MiB of addresses in all.
void expect_room(const std::string& wanted_for, const std::string& needs) {
  constexpr int kThreads = 4;
  constexpr std::size_t kBytes = std::size_t{80} << 20, kAddresses = std::size_t{448} << 20;
  const std::size_t stack = usual_stack_bytes();
  if (!has_addresses(kAddresses) || !has_memory(kBytes + kThreads * stack)) {
    throw no_memory(wanted_for);
  }
  if (threads_to_be_had(kThreads, stack) < kThreads) {
    throw Error(wanted_for + ": " + needs + " four more threads than the system can start",
                Fault::kRetry);
  }
}

Module find(const std::string& wanted_for, const std::string& needs) {
  const fs::path path = module_file("limpid_formats.so", wanted_for + ": " + needs);
  expect_room(wanted_for, needs);
  void* library = open_module(path, "format", kFormatsAbi);
  Module found{};
  const auto get = [&]<class Function>(Function& function, const char* name) {
    function = reinterpret_cast<Function>(module_function(library, path, name));
  };
  get(found.read, "limpid_formats_read");
  get(found.write8, "limpid_formats_write8");
  get(found.config, "limpid_formats_config");
  get(found.open_display, "limpid_formats_open_display");
  get(found.display, "limpid_formats_display");
  get(found.close_display, "limpid_formats_close_display");
  return found;
}

}  // namespace

const Module& module(const std::string& wanted_for, const std::string& needs) {
  static const Module loaded = find(wanted_for, needs);
  return loaded;
}

}  // namespace limpid::formats

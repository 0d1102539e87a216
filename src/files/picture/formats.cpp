#include "files/picture/formats.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include <dlfcn.h>

#include "limpid/core/error.h"

#include "core/memory.h"
#include "core/threads.h"

namespace limpid::formats {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "limpid_formats.so";

/// The build tree has the module where an installed tree has it.
std::vector<fs::path> module_folders() {
  if (const char* named = std::getenv("LIMPID_MODULE_DIR")) return {named};
  std::vector<fs::path> bases;
  std::error_code ignored;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", ignored); !program.empty()) {
    bases.push_back(program.parent_path());
  }
  // A relative name would be looked for in the current folder: anybody's.
  if (Dl_info here; dladdr(reinterpret_cast<const void*>(&module), &here) != 0 &&
                    fs::path(here.dli_fname).is_absolute()) {
    const fs::path library = fs::path(here.dli_fname).parent_path();
    if (bases.empty() || bases.front() != library) bases.push_back(library);
  }
  std::vector<fs::path> folders;
  for (const fs::path& base : bases) {
    for (const fs::path& folder :
         {base, base / "limpid", base / ".." / LIMPID_LIBRARY_FOLDER / "limpid"}) {
      folders.push_back(folder.lexically_normal());
    }
  }
  return folders;
}

void* symbol(void* library, const fs::path& path, const char* name) {
  void* found = dlsym(library, name);
  if (found == nullptr) throw Error(path.string() + ": expected a function " + name);
  return found;
}

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
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw Error(std::string("cannot load the format module: ") + dlerror());
  const auto abi =
      reinterpret_cast<decltype(&limpid_formats_abi)>(symbol(library, path, "limpid_formats_abi"));
  if (abi() != kFormatsAbi) {
    throw Error(path.string() + ": format module of version " + std::to_string(abi()) +
                ": expected " + std::to_string(kFormatsAbi));
  }
  return {reinterpret_cast<decltype(&limpid_formats_read)>(
              symbol(library, path, "limpid_formats_read")),
          reinterpret_cast<decltype(&limpid_formats_write8)>(
              symbol(library, path, "limpid_formats_write8"))};
}

Module find(const std::string& wanted_for) {
  std::vector<std::string> searched;
  for (const fs::path& folder : module_folders()) {
    std::error_code ignored;
    if (fs::exists(folder / kFile, ignored)) return load(folder / kFile, wanted_for);
    searched.push_back(folder.string());
  }
  throw Error(wanted_for + ": formats other than EXR, PNG and JPEG need " + kFile +
              ", which is not in " + join(searched, " or ") +
              " (the environment variable LIMPID_MODULE_DIR names its folder)");
}

}  // namespace

const Module& module(const std::string& wanted_for) {
  static const Module loaded = find(wanted_for);
  return loaded;
}

}  // namespace limpid::formats

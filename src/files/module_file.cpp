#include "files/module_file.h"

#include <cstdlib>
#include <vector>

#include <dlfcn.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

/// The build tree has the modules in the folders of an installed tree.
std::vector<fs::path> module_folders() {
  if (const char* named = std::getenv("LIMPID_MODULE_DIR")) return {named};
  std::vector<fs::path> bases;
  std::error_code ignored;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", ignored); !program.empty()) {
    bases.push_back(program.parent_path());
  }
  // A relative name would be searched in the current folder, which is untrusted.
  if (Dl_info here; dladdr(reinterpret_cast<const void*>(&module_file), &here) != 0 &&
                    fs::path(here.dli_fname).is_absolute()) {
    const fs::path library = fs::path(here.dli_fname).parent_path();
    if (bases.empty() || bases.front() != library) bases.push_back(library);
    // The Python module lies in PREFIX/lib/python3/dist-packages/limpid.
    const fs::path packages = library.parent_path().filename();
    if (packages == "dist-packages" || packages == "site-packages") {
      bases.push_back(library / "../../..");
    }
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

}  // namespace

fs::path module_file(const std::string& file, const std::string& needs) {
  std::vector<std::string> searched;
  for (const fs::path& folder : module_folders()) {
    std::error_code ignored;
    if (fs::exists(folder / file, ignored)) return folder / file;
    searched.push_back(folder.string());
  }
  throw Error(needs + " " + file + ", which is not in " + join(searched, " or ") +
              " (the environment variable LIMPID_MODULE_DIR names its folder)");
}

void* open_module(const fs::path& path, const std::string& what, unsigned abi) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw Error("cannot load the " + what + " module: " + dlerror());
  const std::string name = "limpid_" + what + "s_abi";
  const auto version =
      reinterpret_cast<unsigned (*)()>(module_function(library, path, name.c_str()));
  if (version() != abi) {
    throw Error(path.string() + ": " + what + " module of version " + std::to_string(version()) +
                ": expected " + std::to_string(abi));
  }
  return library;
}

void* module_function(void* library, const fs::path& path, const char* name) {
  void* found = dlsym(library, name);
  if (found == nullptr) throw Error(path.string() + ": expected a function " + name);
  return found;
}

}  // namespace limpid

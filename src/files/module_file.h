#pragma once
#include <filesystem>
#include <string>

namespace limpid {

/// Where one of our modules lies: libraries that are opened when somebody first needs them, for
/// what they link is large. `needs` begins the sentence of the Error where it is nowhere: "a.tif:
/// formats other than EXR, PNG and JPEG need FILE, which is not in ...".
std::filesystem::path module_file(const std::string& file, const std::string& needs);

/// Opens a module for the rest of the program. `what` it is: "format"; `abi` is the version that
/// its function `limpid_WHATs_abi` must give. Throws Error.
void* open_module(const std::filesystem::path& path, const std::string& what, unsigned abi);

/// A function of a module that is open. Throws Error where it has none of that name.
void* module_function(void* library, const std::filesystem::path& path, const char* name);

}  // namespace limpid

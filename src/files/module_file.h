#pragma once
#include <filesystem>
#include <string>

namespace limpid {

/// The path of a limpid module: a library that is opened on first use, because it links large
/// libraries. `needs` begins the sentence of the Error if the module is missing: "a.tif: formats
/// other than EXR, PNG and JPEG need FILE, which is not in ...".
std::filesystem::path module_file(const std::string& file, const std::string& needs);

/// Opens a module for the rest of the program. `what`: its kind, such as "format"; `abi`: the
/// version that its function `limpid_WHATs_abi` must return. Throws Error.
void* open_module(const std::filesystem::path& path, const std::string& what, unsigned abi);

/// A function of an open module. Throws Error if there is none of that name.
void* module_function(void* library, const std::filesystem::path& path, const char* name);

}  // namespace limpid

#include "data_folder.h"

#include <cstdlib>

#include "limpid/load/look_file.h"

namespace limpid::tool {

std::vector<std::filesystem::path> look_folders() {
  std::vector<std::filesystem::path> folders;
  if (const char* data = std::getenv("LIMPID_DATA")) {
    folders.push_back(std::filesystem::path(data) / "looks");
  }
  std::error_code ignored;
  const std::filesystem::path tool = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (!tool.empty()) folders.push_back(tool.parent_path() / "../share/limpid/looks");
  folders.push_back(std::filesystem::path(LIMPID_SOURCE_DATA) / "looks");
  return folders;
}

Look look_for(std::string_view name_or_file) { return look_named(name_or_file, look_folders()); }

}  // namespace limpid::tool

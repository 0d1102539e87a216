#include "data_folder.h"

#include <cstdlib>

#include "limpid/core/error.h"
#include "limpid/files/text/look_file.h"

namespace limpid::tool {

namespace {

/// Best first.
std::vector<std::filesystem::path> data_folders() {
  std::vector<std::filesystem::path> folders;
  if (const char* data = std::getenv("LIMPID_DATA")) folders.emplace_back(data);
  std::error_code ignored;
  const std::filesystem::path tool = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (!tool.empty()) folders.push_back(tool.parent_path() / "../share/limpid");
  return folders;
}

}  // namespace

std::filesystem::path data_folder() {
  std::vector<std::string> searched;
  for (const std::filesystem::path& folder : data_folders()) {
    searched.push_back(folder.string());
    bool has_all = true;
    for (const char* part : {"looks", "scenes", "plates", "maps"}) {
      std::error_code ignored;
      has_all &= std::filesystem::is_directory(folder / part, ignored);
    }
    if (has_all) return folder;
  }
  throw Error("no data: expected looks, scenes, plates and maps in one of " + join(searched));
}

std::vector<std::filesystem::path> look_folders() {
  std::vector<std::filesystem::path> folders;
  for (const std::filesystem::path& data : data_folders()) {
    folders.insert(folders.end(), {data / "looks", data / "presets"});
  }
  return folders;
}

std::filesystem::path cache_folder() {
  const char* const folder = std::getenv("XDG_CACHE_HOME");
  if (folder && *folder) return std::filesystem::path(folder) / "limpid";
  const char* const home = std::getenv("HOME");
  return home && *home ? std::filesystem::path(home) / ".cache/limpid" : std::filesystem::path();
}

Look look_for(std::string_view name_or_file) { return look_named(name_or_file, look_folders()); }

}  // namespace limpid::tool

#include "judge/report/report_files.h"

#include "limpid/core/error.h"

#include "files/atomic_file.h"

namespace limpid {

void make_folder_for(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error) && std::filesystem::exists(folder, error)) {
    throw Error(folder.string() + ": is not a folder: expected a folder for the report, or none");
  }
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(folder.string() + ": cannot be created (" + error.message() + ")");
  for (const std::string& name : names) expect_replaceable(folder / name);
}

void write_whole(const std::filesystem::path& path, const std::string& text) {
  AtomicFiles files;
  files.add(path).write(text);
  files.commit();
}

}  // namespace limpid

#include <fstream>

#include "limpid/core/error.h"
#include "limpid/report/report.h"

#include "report/page.h"
#include "report/report_json.h"
#include "write/atomic_file.h"

namespace limpid {
namespace {

void write_whole(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (!stream) throw Error(path.string() + ": cannot be written (disk full?)", Fault::kRetry);
  file.commit();
}

}  // namespace

void make_report_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error) && std::filesystem::exists(folder, error)) {
    throw Error(folder.string() + ": is there and not a folder, so no report is written into it");
  }
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(folder.string() + ": cannot be made (" + error.message() + ")");
  for (const char* name : {"report.json", "index.html"}) AtomicFile{folder / name};
}

void write_report(const std::filesystem::path& folder, const Report& report) {
  make_report_folder(folder);
  // The page comes last: where it is, the rows are.
  write_whole(folder / "report.json", to_json(report));
  write_whole(folder / "index.html", to_html(report));
}

}  // namespace limpid

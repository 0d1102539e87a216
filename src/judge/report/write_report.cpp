#include "judge/report/page.h"
#include "judge/report/report.h"
#include "judge/report/report_files.h"
#include "judge/report/report_json.h"

namespace limpid {

void make_report_folder(const std::filesystem::path& folder) {
  make_folder_for(folder, {"report.json", "index.html"});
}

void write_report(const std::filesystem::path& folder, const Report& report) {
  make_report_folder(folder);
  // The page is written last: if it exists, the rows do.
  write_whole(folder / "report.json", to_json(report));
  write_whole(folder / "index.html", to_html(report));
}

}  // namespace limpid

#include "files/atomic_file.h"
#include "judge/report/page.h"
#include "judge/report/report_files.h"
#include "judge/shot/shot.h"
#include "judge/shot/shot_files.h"
#include "judge/shot/shot_json.h"

namespace limpid {
namespace {

constexpr const char* kJson = "report.json";
constexpr const char* kPage = "index.html";

}  // namespace

std::vector<std::string> shot_file_names(std::size_t others) {
  std::vector<std::string> names = {kJson,    kPage,      kDryFile,
                                    kWetFile, kTruthFile, difference_file(kTruthFile)};
  for (const AovInfo& info : aovs()) names.push_back(aov_file(info.name));
  for (std::size_t i = 1; i <= others; ++i) {
    names.insert(names.end(), {look_file(i), difference_file(look_file(i))});
  }
  for (const OperatorInfo& info : operators()) {
    names.insert(names.end(), {without_file(info.name), difference_file(without_file(info.name))});
  }
  return names;
}

std::vector<std::string> write_shot(const std::filesystem::path& folder,
                                    ShotMeasurement& measurement) {
  make_folder_for(folder, shot_file_names(measurement.others()));
  AtomicFiles files;
  Shot shot = measurement.measure([&](const ShotPicture& picture, const std::string& png) {
    files.add(folder / picture.file).write(png);
  });
  const std::string json = to_json(shot);
  files.add(folder / kJson).write(json);
  files.add(folder / kPage).write(to_shot_html(json));
  files.commit();
  return std::move(shot.warnings);
}

}  // namespace limpid

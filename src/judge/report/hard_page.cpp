#include "judge/report/hard_page.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "judge/report/measure.h"
#include "judge/report/page.h"
#include "judge/report/report_files.h"

namespace limpid {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchemaVersion = 1;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json_of(const HardRow& row) {
  return {{"group", row.group},
          {"name", row.name},
          {"quantity", row.quantity},
          {"reason", row.reason},
          {"bound", number(row.bound)},
          {"measured", number(row.measured)},
          {"margin", number(row.margin())},
          {"values", row.values},
          {"worst", row.worst},
          {"passed", row.passed()}};
}

std::string json_text(std::span<const HardRow> rows, const ReportMachine& machine,
                      const ReportBuild& build) {
  Json list = Json::array();
  for (const HardRow& row : rows) list.push_back(json_of(row));
  const Json json{{"schema", "limpid-hard"},
                  {"schema_version", kSchemaVersion},
                  {"limpid", build.version},
                  {"compiler", build.compiler},
                  {"processor", machine.processor},
                  {"simd", machine.simd},
                  {"rows", list}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

void make_hard_folder(const std::filesystem::path& folder) {
  make_folder_for(folder, {"hard.json", "hard.html"});
}

void write_hard(const std::filesystem::path& folder, std::span<const HardRow> rows) {
  make_hard_folder(folder);
  const std::string json = json_text(rows, this_machine(), this_build());
  write_whole(folder / "hard.json", json);
  write_whole(folder / "hard.html", to_hard_html(json));
}

}  // namespace limpid

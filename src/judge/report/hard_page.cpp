#include "judge/report/hard_page.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "judge/report/html_parts.h"
#include "judge/report/markup.h"
#include "judge/report/measure.h"
#include "judge/report/page_style.h"
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

std::string table(std::span<const HardRow> rows) {
  HtmlTable table(
      "Margin: the share of the bound that is left. A case beyond its bound is set off.",
      {{"case", "", false, true},
       {"measured is", "", false, true},
       {"bound", ""},
       {"measured", ""},
       {"margin", ""},
       {"values", ""},
       {"bound from", "", false, true},
       {"largest at", "", false, true}});
  std::string group;
  for (const HardRow& row : rows) {
    if (row.group != group) table.begin_group();
    group = row.group;
    table.add({row.group + ": " + row.name, row.quantity, Cell(row.bound), Cell(row.measured),
               percent(row.margin(), 1), Cell(double(row.values), std::to_string(row.values)),
               row.reason, row.worst.empty() ? "-" : row.worst},
              !row.passed());
  }
  return table.html();
}

std::string html_text(std::span<const HardRow> rows, const ReportMachine& machine,
                      const ReportBuild& build) {
  std::size_t passed = 0;
  for (const HardRow& row : rows) passed += row.passed();
  return std::string("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n") +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n" +
         "<title>limpid hard cases</title>\n<style>" + kPageStyle +
         "</style>\n</head>\n<body>\n<header>\n<h1>limpid: hard cases</h1>\n<p "
         "class=\"sub\">limpid " +
         escaped(build.version) + ", " + escaped(build.compiler) + ", " +
         escaped(machine.processor) + ", " + escaped(join(machine.simd)) + "</p>\n" +
         paragraph("<b>" + std::to_string(passed) + " of " + std::to_string(rows.size()) +
                   "</b> are within their bounds. What is measured is an error or a count of what "
                   "must not be; chains are run by the reference and by the fused runner on each "
                   "of these instruction sets, and the largest of all counts.") +
         "</header>\n<main>\n" + table(rows) +
         "</main>\n<footer>Made by limpid report --hard.</footer>\n<script>" + kPageScript +
         "</script>\n</body>\n</html>\n";
}

}  // namespace

void make_hard_folder(const std::filesystem::path& folder) {
  make_folder_for(folder, {"hard.json", "hard.html"});
}

void write_hard(const std::filesystem::path& folder, std::span<const HardRow> rows) {
  make_hard_folder(folder);
  const ReportMachine machine = this_machine();
  const ReportBuild build = this_build();
  write_whole(folder / "hard.json", json_text(rows, machine, build));
  write_whole(folder / "hard.html", html_text(rows, machine, build));
}

}  // namespace limpid

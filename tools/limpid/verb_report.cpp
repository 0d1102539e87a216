#include <cstdio>

#include "limpid/core/error.h"
#include "limpid/job/job_files.h"

#include "data_folder.h"
#include "judge/report/hard_page.h"
#include "judge/report/report.h"
#include "shot_report.h"
#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

ReportOptions options_of(const ReportArguments& a, const CommonArguments& common) {
  ReportOptions options;
  if (a.quick) {
    options.size = {160, 90};
    options.rounds = 2;
  }
  if (a.size) options.size = size_named(*a.size, kLeastReportSide, kMaxReportSide);
  if (a.rounds) options.rounds = *a.rounds;
  options.threads = common.threads;
  options.gpu = a.gpu;
  options.data = data_folder();
  if (!common.quiet) {
    options.progress = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  }
  return options;
}

/// Throws Error if a file of these names in the folder is, by a link, one of the report's inputs.
void expect_apart_from_data(const std::string& folder, std::initializer_list<const char*> names) {
  JobFiles files;
  const std::filesystem::path data = data_folder();
  for (const char* part : {"looks", "scenes", "plates", "maps"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(data / part)) {
      if (entry.is_regular_file()) files.inputs.push_back(entry.path());
    }
  }
  for (const char* name : names) files.outputs.push_back(std::filesystem::path(folder) / name);
  expect_apart(files);
}

void print_files(const std::string& folder, std::initializer_list<const char*> names) {
  for (const char* name : names)
    std::printf("%s\n", (std::filesystem::path(folder) / name).c_str());
}

/// Exit code 1 if a case is beyond its bound.
int hard_cases(const ReportArguments& a, const CommonArguments& common) {
  if (a.quick || a.size || a.rounds) {
    throw Error(
        "report --hard: expected no --size, --rounds or --quick, since hard cases have their own "
        "sizes",
        Fault::kUsage);
  }
  expect_apart_from_data(a.output, {"hard.json", "hard.html"});
  make_hard_folder(a.output);
  const GpuOptions gpu{.device = a.gpu};
  const HardSuite suite(data_folder(), common.threads, a.gpu.empty() ? nullptr : &gpu);
  const std::vector<HardRow> rows = suite.measure_all();
  write_hard(a.output, rows);
  if (!common.quiet) {
    std::printf("%s", to_text(rows).c_str());
    print_files(a.output, {"hard.json", "hard.html"});
  }
  std::vector<std::string> beyond;
  for (const HardRow& row : rows) {
    if (!row.passed()) beyond.push_back(row.group + ": " + row.name);
  }
  if (!beyond.empty()) throw Error("hard cases are beyond their bounds: " + join(beyond));
  return 0;
}

}  // namespace

int report_verb(const ReportArguments& a, const CommonArguments& common) {
  if (a.output.empty()) throw Error("no output: expected -o FOLDER", Fault::kUsage);
  if (is_of_shot(a)) return shot_report(a, common);
  expect_no_shot_options(a);
  if (a.hard) return hard_cases(a, common);
  const ReportOptions options = options_of(a, common);
  options.validate();
  expect_apart_from_data(a.output, {"report.json", "index.html"});
  make_report_folder(a.output);
  write_report(a.output, measure_report(options));
  if (!common.quiet) print_files(a.output, {"report.json", "index.html"});
  return 0;
}

}  // namespace limpid::tool

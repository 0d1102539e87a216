#include <cstdio>

#include "limpid/core/error.h"
#include "limpid/report/report.h"

#include "data_folder.h"
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
  if (a.size) options.size = size_named(*a.size);
  if (a.rounds) options.rounds = *a.rounds;
  options.threads = common.threads;
  options.data = data_folder();
  if (!common.quiet) {
    options.progress = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  }
  return options;
}

}  // namespace

int report_verb(const ReportArguments& a, const CommonArguments& common) {
  if (a.output.empty()) throw Error("no output: expected -o FOLDER", Fault::kUsage);
  const ReportOptions options = options_of(a, common);
  options.validate();
  make_report_folder(a.output);
  write_report(a.output, measure_report(options));
  if (!common.quiet) {
    for (const char* name : {"report.json", "index.html"}) {
      std::printf("%s\n", (std::filesystem::path(a.output) / name).c_str());
    }
  }
  return 0;
}

}  // namespace limpid::tool

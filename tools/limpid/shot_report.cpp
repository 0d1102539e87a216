#include "shot_report.h"

#include <cstdio>
#include <filesystem>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/files/text/look_file.h"
#include "limpid/job/job_files.h"

#include "compared_picture.h"
#include "composite_job.h"
#include "data_folder.h"
#include "given.h"
#include "job/composite_inputs.h"
#include "judge/shot/shot.h"
#include "memory_limit.h"
#include "notes.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

/// What every shot is compared with, where it is not the shot's own look.
constexpr const char* kCompared[] = {"physical", "fast"};

/// The looks that the shot's is compared with, with the settings of the command line.
std::vector<Look> others_of(const ReportArguments& a) {
  std::vector<std::string> names(std::begin(kCompared), std::end(kCompared));
  names.insert(names.end(), a.against.begin(), a.against.end());
  std::vector<Look> looks;
  for (const std::string& name : names) {
    WaterOptions water = a.composite.water;
    water.look = name;
    looks.push_back(look_of(water));
  }
  return looks;
}

ShotOptions options_of(const ReportArguments& a, const CommonArguments& common) {
  CompositeArguments plate = a.composite;
  if (plate.water.look.empty()) plate.water.look = WaterOptions{}.look;
  ShotOptions options;
  options.job = common_job(plate, {}, common);
  options.others = others_of(a);
  if (!a.truth.empty()) {
    PictureColor color =
        read_color(a.truth, scene_of(options.job, Plate::open(options.job.plate)).primaries,
                   limits_of(common));
    options.truth = {std::filesystem::path(a.truth).filename().string(), color.display,
                     std::move(color.planes)};
  }
  if (a.rounds) options.rounds = *a.rounds;
  options.threads = common.threads;
  if (!common.quiet) {
    options.progress = [](const std::string& line) {
      std::fprintf(stderr, "%s\n", one_line(line).c_str());
    };
  }
  return options;
}

/// Throws Error where a file of the page is, be it by a link, one that the shot is made from.
void expect_apart_from_page(const ShotOptions& options, const ReportArguments& a) {
  JobFiles files = files_of(options.job);
  files.outputs.clear();
  files.inputs.emplace_back(a.truth);
  for (const Look& look : options.others) {
    files.inputs.emplace_back(look.file);
    files.inputs.emplace_back(look.of<WaveNormals>().map);
  }
  for (const std::string& name : shot_file_names(options.others.size())) {
    files.outputs.push_back(std::filesystem::path(a.output) / name);
  }
  expect_apart(files);
}

}  // namespace

bool is_of_shot(const ReportArguments& a) {
  return !a.composite.plates.empty() || !a.composite.scene.empty() || !a.composite.layers.empty();
}

void expect_no_shot_options(const ReportArguments& a) {
  const CompositeArguments& c = a.composite;
  const Given given[] = {
      {"--look", !c.water.look.empty()},       {"--set", !c.water.settings.empty()},
      {"--time", c.water.time.has_value()},    {"--samples", c.samples != 1},
      {"--simd", !c.water.simd.empty()},       {"--view", !c.view.empty()},
      {"--depth-kind", !c.depth_kind.empty()}, {"--depth-nothing", c.depth_nothing.has_value()},
      {"--colorspace", !c.colorspace.empty()}, {"--truth", !a.truth.empty()},
      {"--against", !a.against.empty()}};
  refuse_given("report", given, "is for a shot: expected PLATE... or --scene beside it");
}

int shot_report(const ReportArguments& a, const CommonArguments& common) {
  const Given given[] = {{"--size", a.size.has_value()},
                         {"--quick", a.quick},
                         {"--hard", a.hard},
                         {"--gpu", !a.gpu.empty()}};
  refuse_given("report", given,
               "is not for a shot: expected no PLATE, --scene or --layer beside it");
  const auto executor = executor_of(common);
  ShotOptions options = options_of(a, common);
  expect_apart_from_page(options, a);
  ShotMeasurement shot(std::move(options), *executor);
  tell_warnings(write_shot(a.output, shot), common.quiet);
  if (!common.quiet) {
    for (const char* name : {"report.json", "index.html"}) {
      std::printf("%s\n", (std::filesystem::path(a.output) / name).c_str());
    }
  }
  return 0;
}

}  // namespace limpid::tool

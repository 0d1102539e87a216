#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/job/composite.h"
#include "limpid/job/sequence.h"

#include "compared_picture.h"
#include "composite_job.h"
#include "desk/serve.h"
#include "frame_options.h"
#include "known_looks.h"
#include "memory_limit.h"
#include "notes.h"
#include "open_browser.h"
#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

/// The words of a command line that mean the same plate, computed in the same way.
std::vector<std::string> command_of(const CompositeArguments& a, const CommonArguments& common) {
  std::vector<std::string> words = {"composite"};
  words.insert(words.end(), a.plates.begin(), a.plates.end());
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  add("--scene", a.scene);
  for (const std::string& layer : a.layers) add("--layer", layer);
  add("--view", a.view);
  add("--depth-kind", a.depth_kind);
  add("--colorspace", a.colorspace);
  if (a.depth_nothing) add("--depth-nothing", to_string(Value(*a.depth_nothing)));
  if (a.frames.fps) add("--fps", to_string(Value(*a.frames.fps)));
  if (a.samples != 1) add("--samples", std::to_string(a.samples));
  if (a.water.runner != WaterOptions{}.runner) add("--runner", a.water.runner);
  add("--gpu", a.water.gpu);
  add("--simd", a.water.simd);
  if (common.threads != 0) add("--threads", std::to_string(common.threads));
  add("--max-memory", common.max_memory.value_or(""));
  return words;
}

DeskOptions desk_options(const ViewArguments& a, const CommonArguments& common) {
  CompositeArguments plate = a.composite;
  const DisplayChoice display = display_of(plate.water, true);
  plate.water.display = plate.water.ocio = "";  // of the page, not of files
  const Sequence sequence = sequence_of(plate.frames, plate.water);
  const CompositeJob job = common_job(plate, sequence, common);
  expect_one_view(job, "view");
  DeskOptions options;
  options.frames = sequence.frames;
  options.job_of = [plate, job](std::optional<int> frame) {
    return frame ? job_of_frame(job, plate, *frame) : job;
  };
  options.fps = plate.frames.fps.value_or(kUsualFps);
  options.looks = known_looks(plate.water.look);
  options.start = plate.water.look;
  options.settings = plate.water.settings;
  if (!a.reference.empty()) {
    options.reference = [name = a.reference, common](std::optional<int> frame,
                                                     const Primaries& primaries) {
      return read_color(frame ? name_of_frame(name, *frame) : name, primaries, limits_of(common))
          .planes;
    };
  }
  options.display = display;
  options.folder = a.folder;
  if (!std::filesystem::is_directory(options.folder)) {
    throw Error("--folder " + a.folder + ": expected an existing folder", Fault::kUsage);
  }
  options.command = command_of(plate, common);
  options.range = plate.frames.range;
  if (common.max_memory) options.most_bytes = limits_of(common).max_memory / 4;
  return options;
}

/// Reads and computes the page's first requests in advance, while the browser starts.
void warm(Desk& desk, const CommonArguments& common) {
  try {
    PictureRequest first;
    first.look = desk.options().start;
    first.settings = desk.options().settings;
    first.half = true;
    desk.paint(first);
  } catch (const Error& error) {
    tell_warnings({error.what()}, common.quiet);  // the page reports it, too
  }
}

}  // namespace

int view_verb(const ViewArguments& a, const CommonArguments& common) {
  share_heap();
  const auto executor = executor_of(common);
  Desk desk(desk_options(a, common), *executor);
  tell_warnings(desk.facts().warnings, common.quiet);
  DeskServer server(desk, a.port);
  std::printf("%s\n", server.address().c_str());
  std::fflush(stdout);
  if (!a.no_browser && !open_browser(server.address()) && !common.quiet) {
    std::fprintf(stderr, "no browser could be opened (xdg-open): open the address yourself\n");
  }
  warm(desk, common);
  server.wait();  // until a signal ends the program
  throw Error("the system accepts no more connections", Fault::kRetry);
}

}  // namespace limpid::tool

#include "farm_work.h"

#include <algorithm>
#include <memory>

#include "limpid/core/error.h"
#include "limpid/core/simd.h"

#include "composite_job.h"
#include "frame_options.h"
#include "notes.h"
#include "scene_jobs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

void expect_cuttable(const FrameOptions& frames, const WaterOptions& water) {
  const auto refuse = [](const std::string& sentence) { throw Error(sentence, Fault::kUsage); };
  if (water.dry_run) refuse("-n makes no frame: expected --dry-run before the --");
  if (frames.range.empty()) refuse("farm: expected --frames RANGE in the command after --");
  if (frames.verify)
    refuse("--verify: expected none, since the farm's last job verifies every byte");
  if (missing_named(frames.missing) == Missing::kHold) {
    refuse(
        "--missing hold: expected error or skip, since a task does not see the frames of other "
        "tasks");
  }
}

/// The common part of all kinds.
FarmWork begin(const std::string& verb, const FrameOptions& frames, const WaterOptions& water,
               const CommonArguments& common) {
  expect_cuttable(frames, water);
  expect_output(water.output);
  FarmWork work;
  work.verb = verb;
  work.sequence = sequence_of(frames, water);
  work.range = frames.range;
  for (const std::string& name : {water.output, water.preview, water.deep}) {
    if (!name.empty()) work.outputs.push_back(name);
  }
  work.names_simd = !water.simd.empty();
  work.simd = work.names_simd ? water.simd : simd_targets().front();
  if (!water.preview.empty() && water.ocio.empty() && water.display != kPlainDisplay) {
    // $OCIO may differ where a task runs.
    const DisplayChoice display = display_of(water, true);
    if (display.config.empty()) {
      work.display = {"--display", kPlainDisplay};
    } else {
      work.display = {"--ocio", display.config.string()};
    }
  }
  work.common = common;
  return work;
}

FarmWork composite_work(const CompositeArguments& a, const CommonArguments& common) {
  FarmWork work = begin("composite", a.frames, a.water, common);
  const CompositeJob job = common_job(a, work.sequence, common);
  if (job.output.runner == Runner::kReference) work.simd.clear();
  const FilledSequence filled = fill_missing(
      work.sequence.frames, [=](int frame) { return job_of_frame(job, a, frame); },
      missing_named(a.frames.missing));
  tell_missing(filled, work.sequence.frames.size(), common);
  work.sequence.frames = filled.frames;
  work.faults = [sequence = work.sequence, filled](Executor& executor) {
    return faults_of_composite(sequence, filled.job_of, executor);
  };
  work.rest = [sequence = work.sequence, filled](Executor& executor, VerifyLevel level) {
    return rest_of_composite(sequence, filled.job_of, executor, level);
  };
  return work;
}

FarmWork water_work(const RenderArguments& a, const CommonArguments& common) {
  FarmWork work = begin("water", a.frames, a.water, common);
  const WaterJob job = water_job(a, common);
  if (job.output.runner == Runner::kReference) work.simd.clear();
  const auto model =
      std::make_shared<const Model>(model_to_render(job.scene, a.skip_unsupported, common));
  const JobOfFrame<WaterJob> job_of = [=](int frame) { return water_job_of_frame(job, a, frame); };
  work.faults = [=, sequence = work.sequence](Executor& executor) {
    return faults_of_water(*model, sequence, job_of, executor);
  };
  work.rest = [=, sequence = work.sequence](Executor& executor, VerifyLevel level) {
    return rest_of_water(*model, sequence, job_of, executor, level);
  };
  return work;
}

FarmWork truth_work(const TruthArguments& a, const CommonArguments& common) {
  FarmWork work = begin("truth", a.frames, a.water, common);
  const TruthJob job = truth_job(a, common);
  work.simd.clear();
  work.sequence.in_flight = 1;
  const auto model =
      std::make_shared<const Model>(model_to_render(job.scene, a.skip_unsupported, common));
  const JobOfFrame<TruthJob> job_of = [=](int frame) { return truth_job_of_frame(job, a, frame); };
  work.faults = [=, sequence = work.sequence](Executor& executor) {
    return faults_of_truth(*model, sequence, job_of, executor);
  };
  work.rest = [=, sequence = work.sequence](Executor& executor, VerifyLevel level) {
    return rest_of_truth(*model, sequence, job_of, executor, level);
  };
  return work;
}

}  // namespace

Parsed command_of(std::vector<std::string> words) {
  if (words.empty()) {
    throw Error(
        "farm: expected -- and a command after it, as in limpid farm -- composite "
        "plate.####.exr -o wet.####.exr --frames 1-240",
        Fault::kUsage);
  }
  if (std::find(words.begin(), words.end(), "--") != words.end()) {
    throw Error("farm: expected no second -- in the command after the first", Fault::kUsage);
  }
  words.insert(words.begin(), "limpid");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  return parse(static_cast<int>(argv.size()), argv.data());
}

FarmWork farm_work(const Arguments& command) {
  const bool dry_composite = command.verb == Verb::kPlan && command.composite.water.dry_run;
  if (command.verb == Verb::kComposite || dry_composite) {
    return composite_work(command.composite, command.common);
  }
  if (command.verb == Verb::kWater) return water_work(command.render, command.common);
  if (command.verb == Verb::kTruth) return truth_work(command.truth, command.common);
  throw Error("farm: expected composite, water or truth after --", Fault::kUsage);
}

std::vector<std::string> task_words(const std::vector<std::string>& command, const FarmWork& work,
                                    int cores) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (command[i] == "--frames") {
      ++i;
    } else if (command[i] != "--resume" && !command[i].starts_with("--frames=")) {
      words.push_back(command[i]);
    }
  }
  const auto add = [&](const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  if (work.common.threads == 0) add("--threads", std::to_string(cores));
  if (!work.names_simd && !work.simd.empty()) add("--simd", work.simd);
  words.insert(words.end(), work.display.begin(), work.display.end());
  words.push_back("--resume");
  return words;
}

}  // namespace limpid::tool

#include "submission.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <thread>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"

#include "core/ranges_text.h"
#include "farm/chunks.h"
#include "farm/programs.h"
#include "farm/scripts.h"
#include "memory_limit.h"
#include "notes.h"

namespace limpid::tool {
namespace {

namespace fs = std::filesystem;

/// Per task, if the command names no --threads.
constexpr int kUsualCores = 4;
/// Number of frames tried, if the first cannot be made.
constexpr std::size_t kMaxMeasured = 5;

/// A measured frame.
struct Measured {
  int frame;
  double seconds;
  std::int64_t memory;
};

fs::path this_program() { return fs::read_symlink("/proc/self/exe"); }

int cores_of(const FarmArguments& a, const FarmWork& work) {
  if (work.common.threads > 0) return work.common.threads;
  if (!a.at_once) return kUsualCores;
  const int here = static_cast<int>(std::thread::hardware_concurrency());
  return std::max(here / *a.at_once, 1);
}

/// Makes the first frame that can be made.
Measured measure(const std::vector<std::string>& words, const std::vector<int>& frames) {
  std::string said;
  for (std::size_t i = 0; i < std::min(frames.size(), kMaxMeasured); ++i) {
    std::vector<std::string> command{this_program().string()};
    command.insert(command.end(), words.begin(), words.end());
    command.insert(command.end(), {"--frames", std::to_string(frames[i])});
    const ProgramRun run = run_program(command);
    if (run.code == 0) return {frames[i], run.seconds, run.memory};
    std::string sentence = last_words(run);
    if (const std::string mark = "limpid ERROR: "; sentence.starts_with(mark)) {
      sentence.erase(0, mark.size());
    }
    if (run.code == 75) throw Error(sentence, Fault::kRetry);
    if (said.empty()) said = sentence;
  }
  throw Error(said + "; this frame was timed first, and " +
              (frames.size() == 1 ? "no other frame is left" : "the next frames failed, too") +
              ": expected a frame that can be made, or --chunk N");
}

/// Memory of a task, with its allocator's reserve.
std::int64_t memory_of(const Measured& measured, int in_flight, int chunk) {
  constexpr std::int64_t kBeside = std::int64_t{128} << 20, kStep = std::int64_t{64} << 20;
  const std::int64_t frames = measured.memory * std::min(in_flight, chunk);
  return (frames + frames / 4 + kBeside + kStep - 1) / kStep * kStep;
}

int minutes_of(const Measured& measured, int chunk) {
  return static_cast<int>(std::ceil(4 * measured.seconds * chunk / 60)) + 5;
}

/// Frames whose picture exists, but cannot be kept.
std::map<int, FileState> states_before(const FarmWork& work, const std::vector<int>& frames) {
  std::map<int, FileState> before;
  for (const int frame : frames) {
    const FileState state = state_of(fs::absolute(name_of_frame(work.outputs.front(), frame)));
    if (!state.empty()) before[frame] = state;
  }
  return before;
}

int chunk_of(const FarmArguments& a, const std::optional<Measured>& measured, std::size_t frames,
             std::size_t most_tasks) {
  if (!a.chunk) return frames_a_task(measured->seconds, frames, most_tasks);
  const auto chunk = static_cast<std::size_t>(*a.chunk);
  if ((frames + chunk - 1) / chunk > most_tasks) {
    throw Error("--chunk " + std::to_string(chunk) + ": " + std::to_string(frames) +
                    " frames are " + std::to_string((frames + chunk - 1) / chunk) +
                    " tasks, expected at most " + std::to_string(most_tasks) +
                    " (Slurm's MaxArraySize)",
                Fault::kUsage);
  }
  return *a.chunk;
}

}  // namespace

void expect_sound(const FarmWork& work, Executor& executor) {
  const std::vector<FrameFault> faults = work.faults(executor);
  if (faults.empty()) return;
  std::string more;
  if (faults.size() > 1) {
    std::vector<int> frames;
    for (std::size_t i = 1; i < faults.size(); ++i) frames.push_back(faults[i].frame);
    std::sort(frames.begin(), frames.end());
    more = " (and errors in " + std::to_string(frames.size()) +
           (frames.size() == 1 ? " more frame: " : " more frames: ") + ranges_text(frames) + ")";
  }
  throw Error("frame " + std::to_string(faults.front().frame) + ": " + faults.front().sentence +
              more);
}

Rest rest_of(const FarmWork& work, const CommonArguments& common, Executor& executor) {
  Rest rest = work.rest(executor, VerifyLevel::kWhole);
  tell_rest(rest, common);
  return rest;
}

Submission prepare(const FarmArguments& a, const FarmWork& work, const FarmFolder& folder,
                   const Rest& rest, std::size_t most_tasks, const CommonArguments& common) {
  Submission made{work, folder, {}, {}, {}, {}, 0, 0};
  made.record.folder = fs::current_path();
  made.record.outputs = work.outputs;
  made.record.frames = work.sequence.frames.size();
  made.record.before = states_before(work, rest.frames);
  const int cores = cores_of(a, work);
  const std::vector<std::string> words = task_words(a.command, work, cores);
  std::vector<int> frames = rest.frames;
  std::optional<Measured> measured;
  if (!a.chunk) {
    measured = measure(words, frames);
    std::erase(frames, measured->frame);
  }
  made.record.kept = made.record.frames - frames.size();
  made.frames = frames.size();
  if (frames.empty()) return made;
  const int chunk = chunk_of(a, measured, frames.size(), most_tasks);
  const std::vector<Chunk> chunks = chunks_of(frames, chunk);
  made.tasks = chunks.size();
  if (measured && !common.quiet) {
    std::fprintf(stderr, "limpid: frame %d took %.2f s and %lld MB: %d frames per task\n",
                 measured->frame, measured->seconds, static_cast<long long>(measured->memory >> 20),
                 chunk);
  }
  FarmPlan plan;
  plan.name = folder.path().stem().string();
  plan.program = this_program();
  plan.folder = made.record.folder;
  plan.farm = folder.path();
  plan.command = words;
  plan.range = work.range;
  plan.tasks = made.tasks;
  plan.cores = cores;
  plan.sbatch = a.sbatch;
  plan.minutes = a.minutes;
  if (measured && !a.minutes) plan.minutes = minutes_of(*measured, chunk);
  if (work.common.max_memory) {
    constexpr std::int64_t kProgram = std::int64_t{256} << 20;
    plan.memory = memory_named(*work.common.max_memory) + kProgram;
  } else if (measured) {
    plan.memory = memory_of(*measured, work.sequence.in_flight, chunk);
  }
  made.chunks = chunks_text(chunks);
  made.task = task_script(plan);
  made.verify = verify_script(plan);
  return made;
}

std::string Submission::text() const {
  std::string all;
  for (const auto& [name, file] : {std::pair{"chunks.txt", &chunks}, std::pair{"task.sh", &task},
                                   std::pair{"verify.sh", &verify}}) {
    all += "---- " + folder.file(name).string() + "\n" + *file;
  }
  return all;
}

void Submission::write() const {
  folder.forget_failures();
  folder.write("chunks.txt", chunks);
  folder.write("task.sh", task);
  folder.write("verify.sh", verify);
  folder.write(record);
}

std::string summarise(const FarmFolder& folder, const FarmWork& work, const FarmStatus& status,
                      Executor& executor) {
  const Rest rest = work.rest(executor, VerifyLevel::kContents);
  FarmVerdict verdict;
  verdict.frames = work.sequence.frames.size();
  verdict.missing = rest.frames;
  std::sort(verdict.missing.begin(), verdict.missing.end());
  for (const Rest::Other& other : rest.others) verdict.why[other.frame] = other.why;
  const std::string text = summary_text(verdict, status);
  folder.write("summary.txt", text);
  return text;
}

}  // namespace limpid::tool

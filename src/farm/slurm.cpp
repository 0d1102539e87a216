#include "farm/slurm.h"

#include <algorithm>
#include <string>

#include "limpid/core/error.h"

#include "farm/programs.h"
#include "farm/slurm_text.h"

namespace limpid {
namespace {

using Words = std::vector<std::string>;

/// kRetry if Slurm's controller does not respond, because it may respond later.
Fault fault_of(const ProgramRun& run) {
  const auto says = [&](const char* words) { return run.err.find(words) != std::string::npos; };
  const bool silent = says("Unable to contact slurm controller") || says("Socket timed out") ||
                      says("Connection refused") || says("temporarily unable") ||
                      says("Resource temporarily unavailable");
  return silent ? Fault::kRetry : Fault::kJob;
}

ProgramRun expect_done(const Words& words) {
  ProgramRun run = run_program(words);
  if (run.code == 0) return run;
  throw Error(words.front() + ": " + last_words(run), fault_of(run));
}

std::string jobs_text(const std::vector<long>& jobs) {
  std::string text;
  for (const long job : jobs) text += (text.empty() ? "" : ",") + std::to_string(job);
  return text;
}

/// squeue reports an error if the only job is unknown: then the queue is empty.
std::vector<SlurmTask> queued(const std::vector<long>& jobs) {
  const ProgramRun run =
      run_program({"squeue", "--noheader", "--array", "--states=all", "--jobs=" + jobs_text(jobs),
                   std::string("--format=") + kSqueueFormat});
  if (run.code != 0 && run.err.find("Invalid job id") == std::string::npos) {
    throw Error("squeue: " + last_words(run), fault_of(run));
  }
  return tasks_of_squeue(run.out);
}

/// Empty without accounting.
std::vector<SlurmTask> accounted(const std::vector<long>& jobs) {
  try {
    const ProgramRun run =
        run_program({"sacct", "--noheader", "--parsable2", "--jobs=" + jobs_text(jobs),
                     std::string("--format=") + kSacctFormat});
    if (run.code == 0) return tasks_of_sacct(run.out);
  } catch (const Error&) {
  }
  return {};
}

}  // namespace

std::size_t most_slurm_tasks() {
  constexpr int kUsual = 1000;
  try {
    const ProgramRun config = expect_done({"scontrol", "show", "config"});
    return static_cast<std::size_t>(most_tasks_of(config.out).value_or(kUsual));
  } catch (const Error& error) {
    throw Error(std::string("Slurm does not answer: ") + error.what() +
                    "; expected Slurm, or --local N to run the tasks here",
                error.fault());
  }
}

std::vector<long> submit(const FarmFolder& folder) {
  const ProgramRun tasks = expect_done({"sbatch", "--parsable", folder.file("task.sh").string()});
  const long job = job_of_sbatch(tasks.out);
  try {
    const ProgramRun last =
        expect_done({"sbatch", "--parsable", "--dependency=afterany:" + std::to_string(job),
                     folder.file("verify.sh").string()});
    return {job, job_of_sbatch(last.out)};
  } catch (const Error&) {
    cancel({job});
    throw;
  }
}

FarmQueue queue_of(const std::vector<long>& jobs) {
  FarmQueue queue;
  try {
    const std::vector<SlurmTask> now = queued(jobs);
    queue.at_work = std::any_of(now.begin(), now.end(),
                                [](const SlurmTask& task) { return !is_over(task.state); });
    // sacct's rows come first, so that squeue's newer rows win.
    queue.tasks = accounted(jobs);
    queue.tasks.insert(queue.tasks.end(), now.begin(), now.end());
    std::erase_if(queue.tasks, [&](const SlurmTask& task) { return task.job != jobs.front(); });
  } catch (const Error& error) {
    queue.at_work.reset();
    queue.note = std::string("Slurm does not answer (") + error.what() + ")";
  }
  return queue;
}

void cancel(const std::vector<long>& jobs) {
  Words words{"scancel"};
  for (const long job : jobs) words.push_back(std::to_string(job));
  expect_done(words);
}

}  // namespace limpid

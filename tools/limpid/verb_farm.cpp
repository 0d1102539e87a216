#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <thread>

#include <unistd.h>

#include "limpid/core/error.h"

#include "core/shell_words.h"
#include "farm/farm_folder.h"
#include "farm/farm_status.h"
#include "farm/local_tasks.h"
#include "farm/programs.h"
#include "farm/scripts.h"
#include "farm/slurm.h"
#include "farm_work.h"
#include "signals.h"
#include "submission.h"
#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

FarmQueue queue_of(const FarmFolder& folder, const FarmRecord& record) {
  if (!record.jobs.empty()) return limpid::queue_of(record.jobs);
  return {{}, !FarmLock::holder(folder).empty(), ""};
}

FarmStatus status_of(const FarmFolder& folder) {
  const FarmRecord record = folder.record();
  return limpid::status_of(folder, record, queue_of(folder, record));
}

/// 0 if complete or at work, 1 if over and incomplete, 75 if the scheduler does not answer.
int exit_code_of(const FarmStatus& status) {
  if (status.complete() || status.at_work == true) return 0;
  return status.at_work ? 1 : 75;
}

int status_verb(const FarmFolder& folder) {
  const FarmStatus status = status_of(folder);
  std::printf("%s", to_text(status).c_str());
  return exit_code_of(status);
}

/// Until no task waits or runs. On a terminal each text replaces the one before.
int watch_verb(const FarmFolder& folder) {
  const bool live = ::isatty(STDOUT_FILENO) == 1;
  std::string shown;
  while (true) {
    const FarmStatus status = status_of(folder);
    const std::string text = to_text(status);
    if (text != shown) {
      if (live && !shown.empty()) {
        std::printf("\033[%dF\033[J",
                    static_cast<int>(std::count(shown.begin(), shown.end(), '\n')));
      }
      std::printf("%s", text.c_str());
      std::fflush(stdout);
      shown = text;
    }
    if (status.at_work == false) return exit_code_of(status);
    std::this_thread::sleep_for(std::chrono::seconds(2));
  }
}

int cancel_verb(const FarmFolder& folder) {
  const FarmRecord record = folder.record();
  if (record.jobs.empty()) {
    const std::string holder = FarmLock::holder(folder);
    throw Error(folder.path().string() + ": the farm has no Slurm job to cancel" +
                (holder.empty() ? "" : "; end " + holder + " to stop it"));
  }
  cancel(record.jobs);
  std::printf("%s", to_text(status_of(folder)).c_str());
  return 0;
}

/// The work of the last job.
int verify_verb(const FarmFolder& folder, const FarmArguments& a) {
  const Parsed command = command_of(a.command);
  if (command.exit_code) return *command.exit_code;
  const FarmWork work = farm_work(command.arguments);
  const auto executor = executor_of(work.common);
  const std::string summary = summarise(folder, work, status_of(folder), *executor);
  std::printf("%s", summary.c_str());
  return summary.find('\n') + 1 == summary.size() ? 0 : 1;
}

/// Runs the tasks on this machine.
int run_here(const FarmFolder& folder, const Submission& submission, int at_once,
             const CommonArguments& common) {
  const FarmRecord record = folder.record();
  run_tasks(folder, submission.tasks, at_once, [&] {
    if (common.quiet) return;
    const FarmStatus status = limpid::status_of(folder, record, {{}, true, ""});
    const std::string text = to_text(status);
    std::fprintf(stderr, "limpid: %s\n", text.substr(0, text.find('\n')).c_str());
  });
  const FarmStatus status = limpid::status_of(folder, record, {{}, false, ""});
  const auto executor = executor_of(submission.work.common);
  const std::string summary = summarise(folder, submission.work, status, *executor);
  const bool complete = summary.find('\n') + 1 == summary.size();
  if (!common.quiet || !complete) std::printf("%s", summary.c_str());
  return complete ? 0 : 1;
}

/// Throws Error if a job of the farm is, or may be, in Slurm's queue.
void expect_over(const FarmFolder& folder) {
  if (!folder.has_record()) return;
  const FarmRecord record = folder.record();
  if (record.jobs.empty()) return;
  const FarmQueue queue = limpid::queue_of(record.jobs);
  if (queue.at_work == false) return;
  const std::string job = "job " + std::to_string(record.jobs.front());
  if (!queue.at_work) {
    throw Error(folder.path().string() + ": the state of its " + job +
                    " is unknown: " + queue.note + "; if the job has ended, remove " +
                    folder.file("farm.json").string(),
                Fault::kRetry);
  }
  throw Error(folder.path().string() + ": its " + job +
              " makes these frames; wait until it ends, or run limpid farm cancel " +
              shell_line({folder.path().string()}));
}

int submit_verb(const FarmArguments& a, const CommonArguments& common) {
  for (const std::string& word : a.sbatch) expect_sbatch_word(word);
  if (a.at_once && !a.sbatch.empty()) {
    throw Error("--sbatch and --local: expected one of them, since --local uses no scheduler",
                Fault::kUsage);
  }
  if (a.at_once && a.minutes) {
    throw Error("--time-limit and --local: expected one of them, since --local uses no scheduler",
                Fault::kUsage);
  }
  if (a.dry_run && !a.chunk) {
    throw Error("--dry-run: expected --chunk N beside it, since a dry run times no frame",
                Fault::kUsage);
  }
  const Parsed command = command_of(a.command);
  if (command.exit_code) return *command.exit_code;
  const FarmWork work = farm_work(command.arguments);
  const auto executor = executor_of(work.common);
  expect_sound(work, *executor);
  const FarmFolder folder(std::filesystem::absolute(farm_folder_of(work.outputs.front())));
  const bool slurm = !a.at_once && !a.dry_run;
  const std::size_t most_tasks = slurm ? most_slurm_tasks() : std::numeric_limits<int>::max();
  if (a.dry_run) {
    const Submission submission =
        prepare(a, work, folder, rest_of(work, common, *executor), most_tasks, common);
    std::printf("%s", submission.text().c_str());
    return 0;
  }
  folder.make();
  const FarmLock lock(folder);
  expect_over(folder);
  const Rest rest = rest_of(work, common, *executor);
  if (rest.frames.empty()) return 0;
  const Submission submission = prepare(a, work, folder, rest, most_tasks, common);
  if (submission.tasks == 0) return 0;
  submission.write();
  if (a.at_once) return run_here(folder, submission, *a.at_once, common);
  FarmRecord record = folder.record();
  record.jobs = submit(folder);
  folder.write(record);
  if (common.quiet) {
    std::printf("%ld\n", record.jobs.front());
  } else {
    std::printf("job %ld: %zu frames in %zu tasks; limpid farm watch %s\n", record.jobs.front(),
                submission.frames, submission.tasks, shell_line({folder.path().string()}).c_str());
  }
  return 0;
}

}  // namespace

int farm_verb(const FarmArguments& a, const CommonArguments& common) {
  also_on_signals(stop_programs);
  if (a.words.empty()) return submit_verb(a, common);
  const std::string& what = a.words.front();
  const auto is = [&](const char* word) { return what == word; };
  if (!is("status") && !is("watch") && !is("cancel") && !is("verify")) {
    throw Error("limpid farm " + what +
                    ": expected status, watch or cancel, or -- before a command" +
                    did_you_mean(what, {"status", "watch", "cancel"}),
                Fault::kUsage);
  }
  if (a.words.size() != 2) {
    throw Error("limpid farm " + what + ": expected one folder of a farm, as in shot/wet.farm",
                Fault::kUsage);
  }
  if (a.chunk || a.at_once || a.minutes || !a.sbatch.empty() || a.dry_run) {
    throw Error("limpid farm " + what + ": expected no other option", Fault::kUsage);
  }
  if (!is("verify") && !a.command.empty()) {
    throw Error("limpid farm " + what + ": expected no command after it", Fault::kUsage);
  }
  const FarmFolder folder(a.words[1]);
  if (is("status")) return status_verb(folder);
  if (is("watch")) return watch_verb(folder);
  if (is("cancel")) return cancel_verb(folder);
  return verify_verb(folder, a);
}

}  // namespace limpid::tool

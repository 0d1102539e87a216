#include "farm/farm_status.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <set>

#include <sys/stat.h>

#include "limpid/files/text/frame_range.h"

#include "core/ranges_text.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

fs::path output_of(const FarmRecord& record, std::size_t which, int frame) {
  return record.folder / name_of_frame(record.outputs[which], frame);
}

bool is_made(const FarmRecord& record, int frame) {
  const FileState picture = state_of(output_of(record, 0, frame));
  const auto before = record.before.find(frame);
  if (picture.empty() || (before != record.before.end() && before->second == picture)) return false;
  for (std::size_t i = 1; i < record.outputs.size(); ++i) {
    if (state_of(output_of(record, i, frame)).empty()) return false;
  }
  return true;
}

double time_of(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return 0;
  return static_cast<double>(status.st_mtim.tv_sec) +
         1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

/// The latest state of each task.
std::map<int, SlurmTask> last_of(const std::vector<SlurmTask>& tasks) {
  std::map<int, SlurmTask> last;
  for (const SlurmTask& task : tasks) last[task.task] = task;
  return last;
}

/// How a task ended that has frames left and does not run.
std::string end_of(const FarmFolder& folder, const FarmRecord& record, int task,
                   const SlurmTask* known) {
  const std::string job = record.jobs.empty() ? "local" : std::to_string(record.jobs.front());
  std::string text = "task " + std::to_string(task) + " has ended";
  if (known) {
    text += " (" + known->state + (known->reason.empty() ? "" : ", " + known->reason) +
            (known->node.empty() ? "" : ", on " + known->node) + ")";
  }
  const fs::path log = folder.file("log") / (job + "." + std::to_string(task) + ".txt");
  return text + (state_of(log).empty() ? "; it has no log" : "; see " + log.string());
}

void add_failures(const FarmFolder& folder, const FarmRecord& record,
                  const std::vector<Chunk>& chunks, const FarmQueue& queue,
                  const std::set<int>& made, FarmStatus& status) {
  const std::map<int, std::string> sentences = folder.failed();
  const std::map<int, SlurmTask> tasks = last_of(queue.tasks);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const int number = static_cast<int>(i) + 1;
    const auto task = tasks.find(number);
    const SlurmTask* known = task == tasks.end() ? nullptr : &task->second;
    const bool over = known ? is_over(known->state)
                            : queue.at_work == false || (queue.at_work && !record.jobs.empty());
    FarmFailure unsaid;
    for (const int frame : chunks[i]) {
      if (made.contains(frame)) continue;
      const auto sentence = sentences.find(frame);
      if (sentence != sentences.end()) {
        status.failed.push_back({{frame}, sentence->second});
      } else if (over) {
        unsaid.frames.push_back(frame);
      }
    }
    if (unsaid.frames.empty()) continue;
    unsaid.sentence = end_of(folder, record, number, known);
    status.failed.push_back(unsaid);
  }
}

std::string duration_text(double seconds) {
  const auto s = static_cast<long long>(std::ceil(seconds));
  if (s < 60) return std::to_string(s) + " s";
  if (s < 3600) return std::to_string(s / 60) + " min " + std::to_string(s % 60) + " s";
  return std::to_string(s / 3600) + " h " + std::to_string(s % 3600 / 60) + " min";
}

}  // namespace

std::vector<int> made_frames(const FarmRecord& record, const std::vector<Chunk>& chunks) {
  std::vector<int> made;
  for (const Chunk& chunk : chunks) {
    for (const int frame : chunk) {
      if (is_made(record, frame)) made.push_back(frame);
    }
  }
  return made;
}

double rate_of(std::vector<double> times) {
  constexpr std::size_t kLast = 60;
  std::sort(times.begin(), times.end(), std::greater<>());
  times.resize(std::min(times.size(), kLast));
  if (times.size() < 2 || !(times.front() > times.back())) return 0;
  return static_cast<double>(times.size() - 1) / (times.front() - times.back());
}

FarmStatus status_of(const FarmFolder& folder, const FarmRecord& record, const FarmQueue& queue) {
  const std::vector<Chunk> chunks = folder.chunks();
  const std::vector<int> made = made_frames(record, chunks);
  FarmStatus status;
  status.frames = record.frames;
  status.done = record.kept + made.size();
  std::vector<double> times;
  for (const int frame : made) times.push_back(time_of(output_of(record, 0, frame)));
  status.frames_per_second = rate_of(std::move(times));
  status.at_work = queue.at_work;
  status.note = queue.note;
  for (const auto& [number, task] : last_of(queue.tasks)) {
    if (is_over(task.state)) {
      ++status.ended;
    } else if (is_running(task.state)) {
      ++status.running;
    } else {
      ++status.waiting;
      if (status.waits_for.empty()) status.waits_for = task.reason;
    }
  }
  add_failures(folder, record, chunks, queue, {made.begin(), made.end()}, status);
  return status;
}

std::string to_text(const FarmStatus& status) {
  std::string text =
      std::to_string(status.done) + " of " + std::to_string(status.frames) + " frames are done";
  if (!status.complete() && status.at_work.value_or(true) && status.frames_per_second > 0) {
    char rate[32];
    std::snprintf(rate, sizeof rate, "%.3g", status.frames_per_second);
    const auto left = static_cast<double>(status.frames - status.done);
    text += std::string(", ") + rate + " frames/s, " +
            duration_text(left / status.frames_per_second) + " left";
  }
  text += "\n";
  if (status.running + status.waiting > 0) {
    text += std::to_string(status.running) + " tasks run, " + std::to_string(status.waiting) +
            " wait" + (status.waits_for.empty() ? "" : " (" + status.waits_for + ")") + "\n";
  }
  if (!status.complete() && status.at_work == false) text += "no task waits or runs\n";
  if (!status.note.empty()) text += status.note + "\n";
  for (const FarmFailure& failure : status.failed) {
    text += std::string(failure.frames.size() == 1 ? "frame " : "frames ") +
            ranges_text(failure.frames) + ": " + failure.sentence + "\n";
  }
  return text;
}

std::string summary_text(const FarmVerdict& verdict, const FarmStatus& status) {
  std::map<int, std::string> why;
  for (const FarmFailure& failure : status.failed) {
    for (const int frame : failure.frames) why.emplace(frame, failure.sentence);
  }
  why.insert(verdict.why.begin(), verdict.why.end());  // does not replace a task's sentence
  std::string text = std::to_string(verdict.frames - verdict.missing.size()) + " of " +
                     std::to_string(verdict.frames) +
                     " frames are complete, by the hashes in their headers\n";
  for (const int frame : verdict.missing) {
    const auto said = why.find(frame);
    text += "frame " + std::to_string(frame) + ": " +
            (said == why.end() ? "is missing" : said->second) + "\n";
  }
  return text;
}

}  // namespace limpid

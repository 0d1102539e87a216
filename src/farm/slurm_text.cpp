#include "farm/slurm_text.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "limpid/core/error.h"

namespace limpid {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number number = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || number < 0) return std::nullopt;
  return number;
}

/// The nonempty lines, each split at its bars.
std::vector<std::vector<std::string_view>> rows(std::string_view text, std::size_t columns,
                                                const std::string& program) {
  std::vector<std::vector<std::string_view>> all;
  for (const std::string_view line : split(text, '\n')) {
    if (line.empty()) continue;
    all.push_back(split(line, '|'));
    if (all.back().size() == columns) continue;
    throw Error(program + " printed '" + std::string(line) + "': expected " +
                std::to_string(columns) + " columns");
  }
  return all;
}

/// "" for Slurm's placeholders of an empty value.
std::string said(std::string_view text) {
  return text == "None" || text == "None assigned" || text == "(null)" ? "" : std::string(text);
}

}  // namespace

bool is_over(std::string_view state) {
  constexpr std::array<std::string_view, 10> kOver{
      "COMPLETED", "FAILED",    "CANCELLED", "TIMEOUT", "NODE_FAIL",
      "PREEMPTED", "BOOT_FAIL", "DEADLINE",  "REVOKED", "OUT_OF_MEMORY"};
  return std::find(kOver.begin(), kOver.end(), state) != kOver.end();
}

bool is_running(std::string_view state) {
  return state == "RUNNING" || state == "COMPLETING" || state == "CONFIGURING" ||
         state == "STAGE_OUT" || state == "SUSPENDED";
}

std::vector<SlurmTask> tasks_of_squeue(std::string_view text) {
  std::vector<SlurmTask> tasks;
  for (const auto& row : rows(text, 5, "squeue")) {
    const auto job = number_of<long>(row[0]);
    const auto task = row[1] == "N/A" ? 0 : number_of<int>(row[1]);
    if (!job || !task) {
      throw Error("squeue printed '" + std::string(row[0]) + "|" + std::string(row[1]) +
                  "': expected numbers of a job and its task");
    }
    tasks.push_back({*job, *task, std::string(row[2]), said(row[3]), said(row[4])});
  }
  return tasks;
}

std::vector<SlurmTask> tasks_of_sacct(std::string_view text) {
  std::vector<SlurmTask> tasks;
  for (const auto& row : rows(text, 4, "sacct")) {
    const std::string_view id = row[0];
    if (id.find_first_of(".[+") != std::string_view::npos) continue;
    const std::size_t bar = id.find('_');
    const auto job = number_of<long>(id.substr(0, bar));
    const auto task = bar == std::string_view::npos ? 0 : number_of<int>(id.substr(bar + 1));
    if (!job || !task) {
      throw Error("sacct printed '" + std::string(id) + "': expected a job or JOB_TASK");
    }
    // "CANCELLED by 1000"
    const std::string_view state = row[1].substr(0, row[1].find(' '));
    const bool plain = row[2].empty() || row[2] == "0:0";
    tasks.push_back({*job, *task, std::string(state),
                     plain ? "" : "exit code " + std::string(row[2]), said(row[3])});
  }
  return tasks;
}

long job_of_sbatch(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  if (const auto job = number_of<long>(line.substr(0, line.find(';')))) return *job;
  throw Error("sbatch printed '" + std::string(line) + "': expected the number of a job");
}

std::optional<int> most_tasks_of(std::string_view config) {
  for (const std::string_view line : split(config, '\n')) {
    if (!line.starts_with("MaxArraySize")) continue;
    const std::size_t last = line.find_last_of(" =");
    const auto size = number_of<int>(line.substr(last == std::string_view::npos ? 0 : last + 1));
    if (size && *size > 1) return *size - 1;  // the exclusive upper limit of task numbers
  }
  return std::nullopt;
}

}  // namespace limpid

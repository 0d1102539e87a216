#include "farm/scripts.h"

#include <algorithm>
#include <string_view>

#include "limpid/core/error.h"

#include "core/shell_words.h"

namespace limpid {
namespace {

bool is_plain(char c) {
  constexpr std::string_view kPlain = "%+,-./:=@_[]*";
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         kPlain.find(c) != std::string_view::npos;
}

/// Removes characters that comments and #SBATCH lines, which have no quotes, cannot hold.
std::string sbatch_name(const std::string& name) {
  std::string plain = "limpid-" + name;
  for (char& c : plain) {
    if (!is_plain(c) || c == '%') c = '_';
  }
  return plain;
}

std::string sbatch_lines(const FarmPlan& plan) {
  std::string lines = "#SBATCH --cpus-per-task=" + std::to_string(plan.cores) + "\n";
  if (plan.memory) {
    constexpr std::int64_t kMega = 1 << 20;
    lines += "#SBATCH --mem=" + std::to_string((*plan.memory + kMega - 1) / kMega) + "M\n";
  }
  if (plan.minutes) lines += "#SBATCH --time=" + std::to_string(*plan.minutes) + "\n";
  lines +=
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --output=/dev/null\n";  // the script has a log of its own
  for (const std::string& word : plan.sbatch) lines += "#SBATCH " + word + "\n";
  return lines;
}

/// The variables of both scripts.
std::string variables(const FarmPlan& plan) {
  return "\nlimpid=" + shell_line({plan.program.string()}) +
         "\nfolder=" + shell_line({plan.folder.string()}) +
         "\nfarm=" + shell_line({plan.farm.string()}) + "\ncommand=(" + shell_line(plan.command) +
         ")\n";
}

constexpr std::string_view kTaskHead = R"sh(#!/bin/bash
# A task of a farm of limpid: it makes the frames that one line of chunks.txt names, the line with the
# number of Slurm's task, or with the number that is given: `bash task.sh 7`, anywhere.
# Exit codes: 0 all frames are there; 1 some cannot be made, each has its sentence in failed/;
# 75 try again; above 128 a signal ended it.
)sh";

constexpr std::string_view kTask = R"sh(
task=${1:-${SLURM_ARRAY_TASK_ID:?expected the number of a line of chunks.txt}}
job=${SLURM_ARRAY_JOB_ID:-local}

# Back into Slurm's queue, @TRIES@ times at most: away from this node, if the partition has another.
try_again() {
  [ "$job" != local ] && [ "${SLURM_RESTART_COUNT:-0}" -lt @TRIES@ ] || return
  trap '' TERM # by which Slurm ends this script now: not before it is through
  scontrol requeue "${job}_$task" || return
  local nodes
  nodes=$(sinfo --noheader --Node --partition="$SLURM_JOB_PARTITION" --states=idle,alloc,mix --format=%N | sort -u | wc -l)
  [ "$nodes" -lt 2 ] || scontrol update JobId="${job}_$task" ExcNodeList="$SLURMD_NODENAME"
  exit 75
}

cd "$folder" && [ -r "$farm/chunks.txt" ] || { try_again; exit 75; } # a file system that is not mounted
exec >>"$farm/log/$job.$task.txt" 2>&1 </dev/null || { try_again; exit 75; }
frames=$(sed -n "${task}p" "$farm/chunks.txt")
[ -n "$frames" ] || { echo "$farm/chunks.txt has no line $task"; exit 2; }
echo "== frames $frames on ${SLURMD_NODENAME:-$(uname -n)}, start $((${SLURM_RESTART_COUNT:-0} + 1))"

"$limpid" "${command[@]}" --frames "$frames"
code=$?
case $code in
  0) exit 0 ;;
  75) try_again ;;
  129 | 130 | 143) exit $code ;; # Slurm or a user ends the task
esac

# One frame cannot be made: all of them once more, each alone; those that are there are left alone.
verdict=0
for frame in ${frames//,/ }; do
  said=$("$limpid" "${command[@]}" --frames "$frame" 2>&1 >/dev/null)
  code=$?
  [ $code != 0 ] || continue
  printf '%s\n' "$said"
  case $code in
    75) try_again ;;
    129 | 130 | 143) exit $code ;;
  esac
  # In this order a reader sees the whole sentence or none.
  sentence=$(printf '%s\n' "$said" | sed -n 's/^limpid ERROR: //p' | tail -n 1)
  printf '%s\n' "${sentence:-frame $frame: limpid ended with exit code $code}" >"$farm/failed/.$frame.$task"
  mv "$farm/failed/.$frame.$task" "$farm/failed/$frame.txt"
  [ $code = 75 ] && [ "$job" = local ] && [ $verdict != 1 ] && verdict=75 || verdict=1
done
exit $verdict
)sh";

constexpr std::string_view kVerifyHead = R"sh(#!/bin/bash
# The last job of a farm of limpid: it looks at every byte of every frame, and writes summary.txt.
# Exit codes: 0 all frames are there and whole, 1 some are not.
)sh";

}  // namespace

void expect_sbatch_word(const std::string& word) {
  if (word.starts_with("--array") || word.starts_with("--wrap")) {
    throw Error("--sbatch " + word +
                    ": expected another option, since the farm's tasks are an array of scripts",
                Fault::kUsage);
  }
  const bool plain = std::all_of(word.begin(), word.end(), is_plain);
  if (plain && word.starts_with("--") && word.size() > 2) return;
  throw Error("--sbatch " + word +
                  ": expected an option of sbatch as one word of letters, digits and " +
                  "%+,-./:=@_[]*, as in --partition=render",
              Fault::kUsage);
}

std::string task_script(const FarmPlan& plan) {
  std::string body(kTask);
  constexpr std::string_view kTries = "@TRIES@";
  for (std::size_t at; (at = body.find(kTries)) != std::string::npos;) {
    body.replace(at, kTries.size(), std::to_string(kMaxTries));
  }
  return std::string(kTaskHead) + "#SBATCH --job-name=" + sbatch_name(plan.name) +
         "\n#SBATCH --array=1-" + std::to_string(plan.tasks) + "\n" + sbatch_lines(plan) +
         variables(plan) + body;
}

std::string verify_script(const FarmPlan& plan) {
  return std::string(kVerifyHead) + "#SBATCH --job-name=" + sbatch_name(plan.name) + "-verify\n" +
         sbatch_lines(plan) + variables(plan) + "\ncd \"$folder\" || exit 75\n" +
         "exec >>\"$farm/log/verify.txt\" 2>&1 </dev/null || exit 75\n" +
         "exec \"$limpid\" farm verify \"$farm\" -- \"${command[@]}\" --frames " +
         shell_line({plan.range}) + "\n";
}

}  // namespace limpid

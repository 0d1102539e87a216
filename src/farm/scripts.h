#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// @file
/// The scripts that a farm's tasks are: for bash, to be read and edited, for Slurm and for any
/// other scheduler that can number its tasks.

namespace limpid {

/// A sequence that is to be made by many tasks.
struct FarmPlan {
  std::string name;                  ///< of its jobs
  std::filesystem::path program;     ///< limpid, absolute
  std::filesystem::path folder;      ///< where the command is at home, absolute
  std::filesystem::path farm;        ///< the farm's own folder, absolute
  std::vector<std::string> command;  ///< words after the program, without --frames
  std::string range;                 ///< all frames, those that are there, too
  std::size_t tasks = 0;
  int cores = 1;
  std::optional<std::int64_t> memory;  ///< bytes of a task
  std::optional<int> minutes;          ///< that a task may take
  std::vector<std::string> sbatch;     ///< further options of sbatch, a word each
};

/// How often Slurm begins a task anew that ended in a way worth trying again.
inline constexpr int kMaxTries = 10;

/// Throws the usage Error for a word that a line of #SBATCH does not hold as it is, and for an
/// option that is the farm's own.
void expect_sbatch_word(const std::string& word);

/// A task: the frames of one line of the farm's chunks.txt.
std::string task_script(const FarmPlan& plan);
/// The last job: looks at all frames and writes summary.txt.
std::string verify_script(const FarmPlan& plan);

}  // namespace limpid

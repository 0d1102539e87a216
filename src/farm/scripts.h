#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// @file
/// The scripts of a farm's tasks: for bash, readable and editable, for Slurm and for any other
/// scheduler with numbered tasks.

namespace limpid {

/// A sequence to be made by many tasks.
struct FarmPlan {
  std::string name;                  ///< of its jobs
  std::filesystem::path program;     ///< limpid, absolute
  std::filesystem::path folder;      ///< working folder of the command, absolute
  std::filesystem::path farm;        ///< the farm's own folder, absolute
  std::vector<std::string> command;  ///< words after the program, without --frames
  std::string range;                 ///< all frames, including existing ones
  std::size_t tasks = 0;
  int cores = 1;
  std::optional<std::int64_t> memory;  ///< bytes per task
  std::optional<int> minutes;          ///< time limit of a task
  std::vector<std::string> sbatch;     ///< further options of sbatch, a word each
};

/// Number of times that Slurm restarts a task after a temporary failure.
inline constexpr int kMaxTries = 10;

/// Throws the usage Error for a word that an #SBATCH line cannot hold, and for an option that the
/// farm sets itself.
void expect_sbatch_word(const std::string& word);

/// A task: the frames of one line of the farm's chunks.txt.
std::string task_script(const FarmPlan& plan);
/// The last job: verifies all frames and writes summary.txt.
std::string verify_script(const FarmPlan& plan);

}  // namespace limpid

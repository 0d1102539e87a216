#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "farm/chunks.h"

/// @file
/// A farm's own folder: what was submitted, and what its tasks say.
///
///     farm.json    what was submitted: FarmRecord
///     chunks.txt   the frames of task N on line N
///     task.sh      a task
///     verify.sh    the last job
///     log/         JOB.TASK.txt, what each task printed; verify.txt
///     failed/      FRAME.txt, a sentence for each frame that could not be made
///     summary.txt  what the last job has found
///     lock         by whom it is submitted right now, or run here

namespace limpid {

/// The state of a file, by which another under its name is known: "" where there is none.
using FileState = std::string;
FileState state_of(const std::filesystem::path& file);

struct FarmRecord {
  std::filesystem::path folder;      ///< where names of outputs begin, absolute
  std::vector<std::string> outputs;  ///< of a frame, with %04d or ####, the picture first
  std::size_t frames = 0, kept = 0;  ///< of the whole range, and how many of these were there
  /// Frames of the farm whose picture was there before, but could not be kept, with its state.
  std::map<int, FileState> before;
  std::vector<long> jobs;  ///< Slurm's: the tasks, and the last one; none of a farm run here
};

/// Beside the outputs, named as they are: shot/wet.farm for shot/wet.####.exr. Where a folder has
/// the frame's number, it lies beside that folder.
std::filesystem::path farm_folder_of(const std::string& output);

/// The folder of one farm. Its files appear whole. All functions throw Error that names the file.
class FarmFolder {
 public:
  explicit FarmFolder(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(const char* name) const { return path_ / name; }

  /// Makes it where it is not there.
  void make() const;
  bool has_record() const;
  FarmRecord record() const;
  std::vector<Chunk> chunks() const;
  void write(const FarmRecord& record) const;
  void write(const char* name, const std::string& text) const;
  /// Frames that could not be made, each with its sentence, without "frame 7: " before it.
  std::map<int, std::string> failed() const;
  /// Forgets failed() and the summary, before the frames are made again.
  void forget_failures() const;

 private:
  std::filesystem::path path_;
};

/// Keeps others from submitting the same farm, or running it, while it lives: a file `lock` with
/// this machine's name and this process's number. Across machines, too, as far as their file system
/// lets one of them alone make a file. What a process of this machine that is no more has left is
/// taken over.
class FarmLock {
 public:
  /// Throws Error of Fault::kRetry that says by whom it is held.
  explicit FarmLock(const FarmFolder& folder);
  ~FarmLock();
  FarmLock(const FarmLock&) = delete;
  FarmLock& operator=(const FarmLock&) = delete;

  /// By whom the farm is held, as in "process 123 on render3", or "" where nobody does.
  static std::string holder(const FarmFolder& folder);

 private:
  std::filesystem::path file_;
};

}  // namespace limpid

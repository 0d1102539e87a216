#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "farm/chunks.h"

/// @file
/// A farm's own folder: its submission, and the results of its tasks.
///
///     farm.json    the submission: FarmRecord
///     chunks.txt   the frames of task N on line N
///     task.sh      a task
///     verify.sh    the last job
///     log/         JOB.TASK.txt, the output of each task; verify.txt
///     failed/      FRAME.txt, a sentence for each failed frame
///     summary.txt  the result of the last job
///     lock         the process that submits the farm, or runs it here

namespace limpid {

/// The state of a file, to notice its replacement: "" if there is no file.
using FileState = std::string;
FileState state_of(const std::filesystem::path& file);

struct FarmRecord {
  std::filesystem::path folder;      ///< base of the outputs' names, absolute
  std::vector<std::string> outputs;  ///< of a frame, with %04d or ####, the picture first
  std::size_t frames = 0, kept = 0;  ///< of the whole range; existing ones kept
  /// Frames of the farm whose picture existed before, but could not be kept, with its state.
  std::map<int, FileState> before;
  std::vector<long> jobs;  ///< Slurm's: the tasks, and the last job; empty for a farm run here
};

/// Beside the outputs, with their name: shot/wet.farm for shot/wet.####.exr. If a folder's name has
/// the frame number, beside that folder.
std::filesystem::path farm_folder_of(const std::string& output);

/// The folder of one farm. Its files appear complete. All functions throw Error that names the
/// file.
class FarmFolder {
 public:
  explicit FarmFolder(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(const char* name) const { return path_ / name; }

  /// Makes the folder if it does not exist.
  void make() const;
  bool has_record() const;
  FarmRecord record() const;
  std::vector<Chunk> chunks() const;
  void write(const FarmRecord& record) const;
  void write(const char* name, const std::string& text) const;
  /// Failed frames, each with its sentence, without the leading "frame 7: ".
  std::map<int, std::string> failed() const;
  /// Removes failed() and the summary, before the frames are made again.
  void forget_failures() const;

 private:
  std::filesystem::path path_;
};

/// Prevents others from submitting or running the same farm, while it lives: a file `lock` with
/// this machine's name and this process's number. Across machines, too, if their file system
/// supports exclusive creation. A lock of an ended process of this machine is taken over.
class FarmLock {
 public:
  /// Throws Error of Fault::kRetry that names the holder.
  explicit FarmLock(const FarmFolder& folder);
  ~FarmLock();
  FarmLock(const FarmLock&) = delete;
  FarmLock& operator=(const FarmLock&) = delete;

  /// The holder of the farm's lock, as in "process 123 on render3", or "".
  static std::string holder(const FarmFolder& folder);

 private:
  std::filesystem::path file_;
};

}  // namespace limpid

#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include <sys/types.h>

#include "tool/tool.h"

namespace limpid::test {

/// A program that runs while the test goes on, and whose stdout is read line by line. It cannot get
/// far ahead of its reader: the pipe between them holds 4096 bytes.
class Running {
 public:
  /// Starts the program without a shell, as run() does.
  Running(const std::filesystem::path& folder, const Words& command);
  /// Kills the program if it is still running.
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  /// The next line without its end; nothing after the last line.
  std::optional<std::string> line();
  /// A descriptor for poll() that hangs up when the program has ended.
  int stdout_end() const { return pipe_; }
  /// Closes the reading end of the pipe.
  void close_stdout();
  void send(int signal) const;
  /// Stops reading, waits for the end, and returns the exit code, or minus the signal that ended
  /// the program.
  int wait();

 private:
  pid_t process_ = 0;
  int pipe_ = -1;
};

}  // namespace limpid::test

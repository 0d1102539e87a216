#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// @file
/// Other programs, run without a shell: each word is an argument, with any content.

namespace limpid {

struct ProgramRun {
  int code = 0;             ///< exit code, or minus the signal that ended it
  std::string out, err;     ///< its output
  double seconds = 0;       ///< wall-clock time
  std::int64_t memory = 0;  ///< largest resident size, in bytes
};

/// Runs a program, searched in PATH unless it has a slash, to its end, with empty standard input,
/// in a process group of its own, with default signal handlers. Throws Error if it cannot be
/// started. Any number of threads may run programs at once.
ProgramRun run_program(const std::vector<std::string>& words);

/// Sends SIGTERM to all running programs and their children. No new ones start afterwards. For a
/// process that ends itself; takes locks, so it must not be called from a signal handler.
void stop_programs();

/// The last line of a program's stderr, without its line end; if there is none, how the program
/// ended.
std::string last_words(const ProgramRun& run);

}  // namespace limpid

#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// @file
/// Other programs, run without a shell: a word is an argument, whatever is in it.

namespace limpid {

struct ProgramRun {
  int code = 0;             ///< exit code, or minus the signal that ended it
  std::string out, err;     ///< what it printed
  double seconds = 0;       ///< wall-clock time
  std::int64_t memory = 0;  ///< bytes resident at once, at most
};

/// Runs a program, found in PATH unless it has a slash, to its end, with nothing on its standard
/// input, in a process group of its own, with all signals as they are by default. Throws Error
/// where it cannot be started. Any threads may run programs at once.
ProgramRun run_program(const std::vector<std::string>& words);

/// Tells all programs that run, and whatever they have started, to stop (SIGTERM). None starts any
/// more. For a process that ends itself; takes locks, so call it from no signal handler.
void stop_programs();

/// The last line of what a program said on stderr, without its end; or, where it said nothing, how
/// it ended.
std::string last_words(const ProgramRun& run);

}  // namespace limpid

#pragma once
#include <functional>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/job/resume.h"
#include "limpid/job/sequence.h"

#include "arguments.h"
#include "job/frame_faults.h"

/// A command line whose frames are made by many tasks.

namespace limpid::tool {

/// The sequence that a command makes, and what can be said of it before and after: by the same
/// jobs as the command's own.
struct FarmWork {
  std::string verb;  ///< composite, water or truth
  Sequence sequence;
  std::string range;                 ///< all of its frames, as --frames takes it
  std::vector<std::string> outputs;  ///< names of a frame's, with %04d or ####, the picture first
  std::string simd;                  ///< instruction set that its bytes depend on, or ""
  bool names_simd = false;           ///< whether the command says so itself
  /// How previews show light, in words that no environment changes: for a command that does not
  /// say.
  std::vector<std::string> display;
  CommonArguments common;
  std::function<std::vector<FrameFault>(Executor&)> faults;
  std::function<Rest(Executor&, VerifyLevel)> rest;
};

/// The command line that the words behind `limpid` are. Throws the usage Error for none.
Parsed command_of(std::vector<std::string> words);

/// What a farm makes of a command line. Throws the usage Error for one that is no sequence of
/// composite, water or truth, or that means something else when it is cut into tasks.
FarmWork farm_work(const Arguments& command);

/// The words of the command that a task runs, but for its --frames: with --resume, and with the
/// threads, the instruction set and the display named.
std::vector<std::string> task_words(const std::vector<std::string>& command, const FarmWork& work,
                                    int cores);

}  // namespace limpid::tool

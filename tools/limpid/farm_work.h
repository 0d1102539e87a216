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

/// The sequence of a command, with functions before and after it: by the same jobs as the command
/// itself.
struct FarmWork {
  std::string verb;  ///< composite, water or truth
  Sequence sequence;
  std::string range;                 ///< all of its frames, in the syntax of --frames
  std::vector<std::string> outputs;  ///< names per frame, with %04d or ####, the picture first
  std::string simd;                  ///< instruction set on which its bytes depend, or ""
  bool names_simd = false;           ///< whether the command names it itself
  /// The display of previews, in words that no environment changes: for a command that does not
  /// name one.
  std::vector<std::string> display;
  CommonArguments common;
  std::function<std::vector<FrameFault>(Executor&)> faults;
  std::function<Rest(Executor&, VerifyLevel)> rest;
};

/// Parses the words after `limpid` as a command line. Throws the usage Error if there are none.
Parsed command_of(std::vector<std::string> words);

/// The farm work of a command line. Throws the usage Error unless it is a sequence of composite,
/// water or truth with the same result when it is split into tasks.
FarmWork farm_work(const Arguments& command);

/// The words of a task's command, without its --frames: with --resume, and with threads,
/// instruction set and display named.
std::vector<std::string> task_words(const std::vector<std::string>& command, const FarmWork& work,
                                    int cores);

}  // namespace limpid::tool

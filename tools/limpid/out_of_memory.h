#pragma once
#include <string>

#include "limpid/core/error.h"

#include "arguments.h"

/// What becomes of the tool when its memory ends.

namespace limpid::tool {

/// Has the process end with the sentence of out_of_memory() and its exit code where nothing could
/// catch an exception that tells of memory: in what a library does as it is loaded, or in a thread
/// of one. To be called first of all.
void end_when_memory_ends();

/// Notes what the sentence names as the limit: --max-memory, `ulimit -v` and `ulimit -d`. To be
/// called before --max-memory itself becomes a limit of the system.
void note_memory_limits(const CommonArguments& common);

/// Whether there is such a limit: more memory will not be there the next time.
bool is_memory_limited();

/// The sentence of an Error of Fault::kMemory, with the limit where there is one.
std::string out_of_memory(std::string sentence);

/// 1 under a limit, 75 where another try may find more memory.
int memory_exit_code();

}  // namespace limpid::tool

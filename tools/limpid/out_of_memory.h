#pragma once
#include <string>

#include "limpid/core/error.h"

#include "arguments.h"

/// The end of the tool when memory runs out.

namespace limpid::tool {

/// Makes the process end with the sentence and exit code of out_of_memory() where nobody can catch
/// an exception for lack of memory: while a library is loaded, or in a library's thread. To be
/// called first of all.
void end_when_memory_ends();

/// Stores the limits for the sentence: --max-memory, `ulimit -v` and `ulimit -d`. To be called
/// before --max-memory becomes a limit of the system.
void note_memory_limits(const CommonArguments& common);

/// Whether there is such a limit: then another try would fail, too.
bool is_memory_limited();

/// The sentence of an Error of Fault::kMemory, with the limit if there is one.
std::string out_of_memory(std::string sentence);

/// 1 under a limit, 75 if another try may find more memory.
int memory_exit_code();

}  // namespace limpid::tool

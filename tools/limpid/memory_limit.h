#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "limpid/files/limits.h"

#include "arguments.h"

/// What --max-memory means.

namespace limpid::tool {

/// Bytes of "2000000000", "1.5G" or "512M", where K, M, G and T are powers of 1024. Throws the
/// usage Error for anything else, and for less than 16M, with which nothing could be done.
std::int64_t memory_named(const std::string& text);

/// The limits of each file that is read: those of the library, and --max-memory.
Limits limits_of(const CommonArguments& common);

/// Has threads take little of what memory there is. Under a limit only, and before there are any.
void make_threads_small();

/// Has the system refuse this process more memory than --max-memory, stacks of threads included,
/// beyond what it has: whatever asks for more, allocating it fails, and the verb with it. To be
/// called before there are threads.
void limit_process(const CommonArguments& common);

}  // namespace limpid::tool

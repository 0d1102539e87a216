#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "limpid/files/limits.h"

#include "arguments.h"

/// Implements --max-memory.

namespace limpid::tool {

/// Parses "2000000000", "1.5G" or "512M", where K, M, G and T are powers of 1024. Throws the usage
/// Error for other text, and for less than 16M, which is too little for any verb.
std::int64_t memory_named(const std::string& text);

/// The limits of each input file: those of the library, and --max-memory.
Limits limits_of(const CommonArguments& common);

/// Makes threads use little memory. Only under a limit, and before there are threads.
void make_threads_small();

/// One heap for all threads: for a server whose threads make one picture after the other. With a
/// heap for each, which is the default, glibc keeps twice the memory that a picture needs.
void share_heap();

/// Makes the system limit this process to --max-memory, thread stacks included, beyond its present
/// memory: allocations beyond that fail, and the verb with them. To be called before there are
/// threads.
void limit_process(const CommonArguments& common);

}  // namespace limpid::tool

#pragma once
#include <cstddef>

/// Memory that the system would give this process, tested by allocating and freeing it. Another
/// thread may take it right after.

namespace limpid {

/// Whether this many bytes can be allocated and written.
bool has_memory(std::size_t bytes);

/// Whether this many contiguous addresses are free, which `ulimit -v` limits.
bool has_addresses(std::size_t bytes);

}  // namespace limpid

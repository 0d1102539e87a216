#pragma once
#include <cstddef>

/// What the system would give this process, asked by taking it and giving it back. Another thread
/// may have it the moment after.

namespace limpid {

/// Whether there are so many bytes to write to.
bool has_memory(std::size_t bytes);

/// Whether there are so many addresses in a row, which `ulimit -v` counts and others do not.
bool has_addresses(std::size_t bytes);

}  // namespace limpid

#pragma once
#include <cstddef>
#include <exception>

namespace limpid {

/// Libraries of file formats also report a good file as "damaged" or "cannot be compressed" if
/// memory runs out while they work. So such a failure counts as the file's only while this much
/// memory is left, more than a library requests at once without reporting a failure.
inline constexpr std::size_t kPlentyOfMemory = std::size_t{32} << 20;

/// Whether a library's exception may come from lack of memory: it says so, or little memory is
/// left.
bool is_for_want_of_memory(const std::exception& error);

}  // namespace limpid

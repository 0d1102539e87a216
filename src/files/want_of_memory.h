#pragma once
#include <cstddef>
#include <exception>

namespace limpid {

/// Libraries of file formats say "damaged" or "cannot be compressed" of a good file, too, when
/// memory ends while they work. So such a failure counts as one of the file while there is this
/// much left, which is more than a library asks for in one piece without saying what it lacks.
inline constexpr std::size_t kPlentyOfMemory = std::size_t{32} << 20;

/// Whether what a library has thrown may come from want of memory: it says so, or there is little.
bool is_for_want_of_memory(const std::exception& error);

}  // namespace limpid

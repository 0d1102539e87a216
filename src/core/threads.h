#pragma once
#include <cstddef>

namespace limpid {

/// Bytes of the stack of a thread for which nobody asks for another.
std::size_t usual_stack_bytes();

/// How many of `wanted` threads with such stacks the system lets this process have: so many are
/// made, and end. The C library keeps their stacks (up to 40 MiB), so that the threads that a
/// library makes next find them even when memory has come to an end meanwhile.
int threads_to_be_had(int wanted, std::size_t stack_bytes);

}  // namespace limpid

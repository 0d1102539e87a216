#pragma once
#include <cstddef>

namespace limpid {

/// Default stack size of a thread, in bytes.
std::size_t usual_stack_bytes();

/// The number of `wanted` threads with such stacks that the system allows this process: it makes
/// them, and ends them. The C library keeps their stacks (up to 40 MiB), so that a library's next
/// threads find them even if memory has run out by then.
int threads_to_be_had(int wanted, std::size_t stack_bytes);

}  // namespace limpid

#pragma once
#include <string>
#include <vector>

namespace limpid {

/// The instruction sets that this library was built for and this machine has, best first; a subset
/// of avx512 avx2 sse4 neon scalar.
std::vector<std::string> simd_targets();

/// The index of `name` in the list of all sets that the library was built for; "" means the best
/// set of this machine. Throws Error for an unknown name, or a set that the machine lacks.
int simd_index(const std::string& name);

}  // namespace limpid

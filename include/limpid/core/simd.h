#pragma once
#include <string>
#include <vector>

namespace limpid {

/// The instruction sets that this library was built for and this machine has, best first: of
/// avx512 avx2 sse4 neon scalar.
std::vector<std::string> simd_targets();

/// Where `name` stands in the list of all sets that the library was built for; "" is the best that
/// this machine has. Throws Error for an unknown name or one that the machine lacks.
int simd_index(const std::string& name);

}  // namespace limpid

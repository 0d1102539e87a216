#pragma once
#include <cstdint>
#include <vector>

namespace limpid {

/// SPIR-V of a shader that asks its driver to keep infinities, NaN and the sign of zero in floats
/// of 32 bits (SPV_KHR_float_controls): without, a compiler may take for granted that there are
/// none.
std::vector<std::uint32_t> keeping_infinity(const std::vector<std::uint32_t>& spirv);

}  // namespace limpid

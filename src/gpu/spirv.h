#pragma once
#include <cstdint>
#include <vector>

namespace limpid {

/// SPIR-V of a shader that requires infinities, NaN and the sign of zero in 32-bit floats
/// (SPV_KHR_float_controls): without it, a compiler may assume that there are none.
std::vector<std::uint32_t> keeping_infinity(const std::vector<std::uint32_t>& spirv);

}  // namespace limpid

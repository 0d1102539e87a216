#pragma once

namespace limpid {

/// Semantic version of library and tool; CMake reads it from here.
inline constexpr const char* kVersion = "0.1.0";

}  // namespace limpid

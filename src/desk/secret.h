#pragma once
#include <string>
#include <string_view>

namespace limpid {

/// 32 hex digits of the system's random source. Throws Error if it fails.
std::string new_secret();

/// Whether both are equal, in a time that does not depend on the equal part.
bool is_same(std::string_view a, std::string_view b);

}  // namespace limpid

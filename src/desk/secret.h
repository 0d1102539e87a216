#pragma once
#include <string>
#include <string_view>

namespace limpid {

/// 32 hex digits of the system's random source. Throws Error where it gives none.
std::string new_secret();

/// Whether both are the same, in a time that does not tell how much of them is.
bool is_same(std::string_view a, std::string_view b);

}  // namespace limpid

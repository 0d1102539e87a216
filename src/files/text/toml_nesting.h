#pragma once
#include <string>
#include <string_view>

namespace limpid {

/// Throws Error, with "name:line: " in front, for a TOML text whose brackets are nested, or whose
/// keys are dotted, deeper than any of our files: toml++ limits the one at 256 and the other not at
/// all, and goes down by recursion. To be called before it.
void check_toml_nesting(std::string_view text, const std::string& name);

}  // namespace limpid

#pragma once
#include <string>
#include <vector>

namespace limpid {

/// Words as a line that a POSIX shell takes apart into the very same words.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace limpid

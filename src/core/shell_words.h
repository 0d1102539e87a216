#pragma once
#include <string>
#include <vector>

namespace limpid {

/// A line that a POSIX shell splits into exactly these words.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace limpid

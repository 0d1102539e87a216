#pragma once
#include <filesystem>

#include "limpid/files/limits.h"

namespace limpid::fuzz {

/// All that the library does with an EXR file before it composites it: opens and inspects it, reads
/// the cameras, every channel of every part, and deep parts flattened as well. What is refused on
/// the way is passed over; throws Error where the file cannot be opened or a channel not be read.
void read_exr(const std::filesystem::path& path, const Limits& limits);

}  // namespace limpid::fuzz

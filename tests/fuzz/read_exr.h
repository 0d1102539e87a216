#pragma once
#include <filesystem>

#include "limpid/files/limits.h"

namespace limpid::fuzz {

/// Takes every step of the library before compositing: opens and inspects an EXR file, reads the
/// cameras, every channel of every part, and deep parts flattened as well. Other refusals are
/// passed over; throws Error if the file cannot be opened or a channel cannot be read.
void read_exr(const std::filesystem::path& path, const Limits& limits);

}  // namespace limpid::fuzz

#pragma once
#include <filesystem>

namespace limpid {

/// Throws Error for a PNG, JPEG or DPX file that ends too early, and for a PNG with a damaged
/// chunk: formats whose common readers make up the missing pixels or complain on stderr. Goes by
/// the first bytes of the file, not its name; says nothing about other formats.
void check_whole(const std::filesystem::path& path);

}  // namespace limpid

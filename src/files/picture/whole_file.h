#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace limpid {

/// Throws Error for a PNG, JPEG or DPX file that ends too early, and for a PNG with a damaged
/// chunk: formats whose common readers make up the missing pixels or complain on stderr. Goes by
/// the first bytes of the file, not its name; says nothing about other formats.
void check_whole(const std::filesystem::path& path);

/// The same of a file in memory, called `name` in the sentence.
void check_whole(std::string_view bytes, const std::string& name);

}  // namespace limpid

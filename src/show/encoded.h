#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "show/shown.h"

namespace limpid {

class AtomicFiles;

/// Red, green and blue, interleaved.
std::vector<std::uint8_t> rgb_of(const Shown& shown);

/// The picture as a PNG.
std::string png_of(const Shown& shown);

/// Writes the picture when the files are committed, in the format of the path's extension, as
/// write_image8().
void write_shown(AtomicFiles& files, const std::filesystem::path& path, const Shown& shown,
                 const std::map<std::string, std::string>& texts);

/// RFC 4648, with padding.
std::string base64(const std::string& bytes);

}  // namespace limpid

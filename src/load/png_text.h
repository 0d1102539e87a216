#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace limpid {

/// Puts texts into a PNG picture in memory, behind its header: an iTXt chunk each, uncompressed,
/// UTF-8, with the key as the keyword (ISO 15948:2003 "Portable Network Graphics", 11.3.4.5).
/// Throws Error for keys that are not 1 ... 79 letters of ASCII, and for what is no PNG.
void add_png_texts(std::vector<char>& png, const std::map<std::string, std::string>& texts);

/// The texts of that kind in a PNG file; none in a file of another format, or one that ends too
/// early. Throws Error for a file that cannot be read.
std::map<std::string, std::string> png_texts(const std::filesystem::path& path);

}  // namespace limpid

#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace limpid {

inline constexpr std::uint32_t kMaxTexts = 1 << 20;

/// Puts texts into a PNG picture in memory, behind its header: an iTXt chunk each, uncompressed,
/// UTF-8, with the key as the keyword (ISO 15948:2003 "Portable Network Graphics", 11.3.4.5).
/// Throws Error for keys that are not 1 ... 79 letters of ASCII, texts of more than kMaxTexts bytes
/// in all, and what is no PNG.
void add_png_texts(std::vector<char>& png, const std::map<std::string, std::string>& texts);

/// The texts of that kind, before the end of the picture, whose key begins with "limpid/"; others
/// are passed over, whatever their size. None in a file of another format, or from where one ends
/// too early. Throws Error for a file that cannot be read, and for more than kMaxTexts bytes of
/// these texts in all.
std::map<std::string, std::string> png_texts(const std::filesystem::path& path);

}  // namespace limpid

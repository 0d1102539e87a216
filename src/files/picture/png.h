#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "files/picture/samples.h"

/// PNG in memory (ISO 15948:2003 "Portable Network Graphics"), by libpng. Checks every checksum of
/// a file, and refuses a file that ends before its last chunk.

namespace limpid {

/// Whether the bytes begin as those of a PNG.
bool begins_as_png(std::string_view bytes);

/// Grays of fewer than 8 bits are scaled to 8, palettes become RGB, and a transparent color becomes
/// alpha. Of the file's other properties only its offset is used (oFFs, in pixels); no gamma or
/// profile is applied. Throws Error, which begins with `name`, for a file that is truncated or
/// damaged, and for pixels that decompress to more than their size allows.
Samples decode_png(std::string_view bytes, const std::string& name, const CheckHeader& check);

/// 8-bit RGB or RGBA (3 or 4 channels, alpha straight), interleaved without padding, marked as
/// sRGB. The texts come before the pixels, an iTXt chunk each, uncompressed, with the key as the
/// keyword. The bytes depend on the other arguments alone; `name` begins the Error for keys that
/// are not 1 ... 79 letters of ASCII, and texts of more than 1 MiB in all.
std::string encode_png(int width, int height, int channels, const std::uint8_t* pixels,
                       const std::map<std::string, std::string>& texts, const std::string& name);

/// The texts written by encode_png() before the end of the picture, whose key begins with
/// "limpid/"; other texts of any size are skipped, and pixels are not decompressed. Throws Error as
/// decode_png() does, and for more than 1 MiB of these texts in all.
std::map<std::string, std::string> png_texts(std::string_view bytes, const std::string& name);

}  // namespace limpid

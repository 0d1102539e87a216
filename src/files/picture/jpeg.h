#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "files/picture/samples.h"

/// JPEG in memory, 8 bits, by libjpeg-turbo.

namespace limpid {

/// Whether the bytes begin as those of a JPEG.
bool begins_as_jpeg(std::string_view bytes);

/// Gray or RGB; four inks, inverted as Adobe writes them, become RGB. Throws Error, which begins
/// with `name`, for a file that is truncated, damaged, of a process that libjpeg-turbo does not
/// support, or of more than 500 scans.
Samples decode_jpeg(std::string_view bytes, const std::string& name, const CheckHeader& check);

/// RGB, interleaved without padding, sides up to 65500, at a quality of 1 ... 100; color has half
/// the resolution. The bytes depend on the other arguments alone; `name` begins the Error for a
/// side that is too long.
std::string encode_jpeg(int width, int height, const std::uint8_t* rgb, int quality,
                        const std::string& name);

}  // namespace limpid

#pragma once
#include <cstddef>
#include <cstdint>

/// The contract between the library and limpid_formats, the module that it loads at need to read
/// and write other formats than EXR, PNG and JPEG. Plain C: no exception, allocation or C++ type
/// crosses it. A function returns 0 when it is done; otherwise it has put one phrase into `error`,
/// which holds kErrorSize bytes, or returns kNoMemory. A change to anything here takes a new
/// kFormatsAbi.
namespace limpid::formats {

inline constexpr unsigned kFormatsAbi = 2;
inline constexpr int kNoMemory = 2;
inline constexpr std::size_t kErrorSize = 1024;

extern "C" {

struct FormatsLimits {
  std::int64_t max_pixels;
  std::int64_t max_side;
  std::int64_t max_channels;
  std::int64_t max_memory;
};

/// What the file's header says, already checked against the limits.
struct FormatsHeader {
  int x0, y0, width, height;  ///< of the pixels, in the coordinates of the display window
  int channels;
  int straight_alpha;        ///< 1 when color is not multiplied by alpha
  const char* const* names;  ///< one a channel
};

/// Gives the memory of the pixels: pixel (x, y) of channel c goes to planes[c][y * stride + x].
/// Returns 0, or anything else to stop the reading.
using FormatsAllocate = int(void* host, const FormatsHeader*, float** planes,
                            std::ptrdiff_t* stride);

/// Takes the bytes of the encoded file. Returns 0, or anything else when it could not.
using FormatsTake = int(void* host, const void* bytes, std::size_t size);

[[gnu::visibility("default")]] unsigned limpid_formats_abi();

[[gnu::visibility("default")]] int limpid_formats_read(const char* path,
                                                       const FormatsLimits* limits,
                                                       FormatsAllocate* allocate, void* host,
                                                       char* error);

/// `format` is an extension without its dot; `pixels` are interleaved, without padding.
[[gnu::visibility("default")]] int limpid_formats_write8(const char* format, int width, int height,
                                                         int channels, const std::uint8_t* pixels,
                                                         FormatsTake* take, void* host,
                                                         char* error);
}

}  // namespace limpid::formats

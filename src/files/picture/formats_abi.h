#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

/// The contract between the library and limpid_formats, the module that it loads on demand to read
/// and write other formats than EXR, PNG and JPEG, and for OpenColorIO. Plain C: no exception,
/// allocation or C++ type crosses it. A function returns 0 on success; otherwise it has put one
/// phrase into `error`, which holds kErrorSize bytes, or returns kNoMemory. Any change here needs a
/// new kFormatsAbi.
namespace limpid::formats {

inline constexpr unsigned kFormatsAbi = 3;
inline constexpr int kNoMemory = 2;
inline constexpr std::size_t kErrorSize = 1024;

/// Prefixes of the lines of limpid_formats_config().
inline constexpr std::string_view kSpaceLine = "space ", kViewLine = "view ";

extern "C" {

struct FormatsLimits {
  std::int64_t max_pixels;
  std::int64_t max_side;
  std::int64_t max_channels;
  std::int64_t max_memory;
};

/// The file's header, already checked against the limits.
struct FormatsHeader {
  int x0, y0, width, height;  ///< of the pixels, in the coordinates of the display window
  int channels;
  int straight_alpha;        ///< 1 if color is not multiplied by alpha
  const char* const* names;  ///< one per channel
};

/// Provides the memory of the pixels: pixel (x, y) of channel c goes to planes[c][y * stride + x].
/// Returns 0, or another value to stop reading.
using FormatsAllocate = int(void* host, const FormatsHeader*, float** planes,
                            std::ptrdiff_t* stride);

/// Receives the bytes of the encoded file. Returns 0, or another value on failure.
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

/// Receives, in one call, a line for each color space of a config of OpenColorIO and each of its
/// aliases, and for each "DISPLAY/VIEW", beginning with the default display and its default view.
[[gnu::visibility("default")]] int limpid_formats_config(const char* config, FormatsTake* take,
                                                         void* host, char* error);

/// A view of a config for one of its color spaces; must be closed. Any number of threads may use
/// it.
struct FormatsDisplay;
[[gnu::visibility("default")]] int limpid_formats_open_display(
    const char* config, const char* space, const char* display, const char* view,
    FormatsDisplay** opened, char* error);
/// Converts interleaved red, green and blue in place.
[[gnu::visibility("default")]] int limpid_formats_display(const FormatsDisplay* display, float* rgb,
                                                          int pixels, char* error);
[[gnu::visibility("default")]] void limpid_formats_close_display(FormatsDisplay* display);
}

}  // namespace limpid::formats

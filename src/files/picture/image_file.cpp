#include "limpid/files/picture/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <exception>
#include <fstream>
#include <map>

#include "limpid/core/error.h"

#include "core/memory.h"
#include "files/atomic_file.h"
#include "files/file_stream.h"
#include "files/picture/formats.h"
#include "files/picture/png_text.h"
#include "files/picture/whole_file.h"
#include "files/want_of_memory.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& letter : extension)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return extension;
}

// What the callback of one read needs; what it throws waits here until C is left behind.
struct Reading {
  ImageFile image;
  std::exception_ptr thrown;
};

int allocate(void* host, const formats::FormatsHeader* header, float** planes,
             std::ptrdiff_t* stride) {
  auto& reading = *static_cast<Reading*>(host);
  try {
    ImageFile& image = reading.image;
    image.window = {header->x0, header->y0, header->x0 + header->width,
                    header->y0 + header->height};
    image.straight_alpha = header->straight_alpha != 0;
    for (int c = 0; c < header->channels; ++c) {
      image.channels.emplace_back(header->names[c]);
      const View<float> view = image.planes.emplace_back(image.window).view();
      planes[c] = view.data;
      *stride = view.y_stride;
    }
    return 0;
  } catch (...) {
    reading.thrown = std::current_exception();
    return 1;
  }
}

std::uint8_t byte_of(float value) {
  return value > 0 ? static_cast<std::uint8_t>(std::min(value, 1.0f) * 255.0f + 0.5f)
                   : std::uint8_t{0};
}

std::vector<std::uint8_t> interleaved(const std::vector<View<const float>>& planes) {
  const Rect window = planes[0].window;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(window.area()) * planes.size());
  for (std::size_t c = 0; c < planes.size(); ++c) {
    std::uint8_t* to = pixels.data() + c;
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x, to += planes.size())
        *to = byte_of(planes[c].at(x, y));
    }
  }
  return pixels;
}

int take(void* host, const void* bytes, std::size_t size) {
  try {
    const char* from = static_cast<const char*>(bytes);
    static_cast<std::vector<char>*>(host)->assign(from, from + size);
    return 0;
  } catch (...) {
    return 1;
  }
}

// What a function of the format module has not done leaves as an Error.
void check_done(const fs::path& path, int result, const std::string& error) {
  if (result == 0) return;
  // Its libraries give any reason when their memory ends.
  if (result == formats::kNoMemory || !has_memory(kPlentyOfMemory)) throw no_memory(path.string());
  throw Error(path.string() + ": " + error);
}

// The name by which the format module knows what the extension means.
const char* format_of(const fs::path& path) {
  static const std::map<std::string, const char*> formats = {
      {".png", "png"}, {".jpg", "jpeg"}, {".jpeg", "jpeg"}, {".tif", "tiff"}, {".tiff", "tiff"}};
  const auto found = formats.find(extension_of(path));
  if (found == formats.end()) {
    throw Error(path.string() + ": 8-bit pictures are written as .png, .jpg or .tif");
  }
  return found->second;
}

void write_whole(const fs::path& path, const std::vector<char>& bytes) {
  AtomicFile file(path);
  errno = 0;
  std::ofstream out(file.temporary(), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) {
    const int cause = errno;
    throw Error(path.string() + ": cannot be written (" + describe(cause) + ")", fault_of(cause));
  }
  file.commit();
}

}  // namespace

ImageFile read_image(const fs::path& path, const Limits& limits) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw Error(path.string() + ": no such file");
  if (!fs::is_regular_file(path, ignored)) throw Error(path.string() + ": expected a file");
  check_whole(path);
  const formats::FormatsLimits asked = {limits.max_pixels, limits.max_side, limits.max_channels,
                                        limits.max_memory};
  Reading reading;
  std::array<char, formats::kErrorSize> error{};
  const int result =
      formats::module(path.string()).read(path.c_str(), &asked, allocate, &reading, error.data());
  if (reading.thrown) std::rethrow_exception(reading.thrown);
  check_done(path, result, error.data());
  return std::move(reading.image);
}

void write_image8(const fs::path& path, const std::vector<View<const float>>& planes,
                  const std::map<std::string, std::string>& texts) {
  const char* format = format_of(path);
  if (planes.size() != 3 && planes.size() != 4) {
    throw Error(path.string() + ": " + std::to_string(planes.size()) + " planes: expected 3 or 4");
  }
  const Rect window = planes[0].window;
  for (const View<const float>& plane : planes) {
    if (plane.window != window || window.empty()) {
      throw Error(path.string() + ": expected planes of one window that is not empty");
    }
  }
  const std::vector<std::uint8_t> pixels = interleaved(planes);
  std::vector<char> bytes;
  std::array<char, formats::kErrorSize> error{};
  const int result =
      formats::module(path.string())
          .write8(format, window.width(), window.height(), static_cast<int>(planes.size()),
                  pixels.data(), take, &bytes, error.data());
  check_done(path, result, error.data());
  if (is_png(path)) add_png_texts(bytes, texts);
  write_whole(path, bytes);
}

void expect_image8(const fs::path& path) {
  format_of(path);
  formats::module(path.string());
}

std::map<std::string, std::string> read_image_texts(const fs::path& path) {
  check_whole(path);
  return png_texts(path);
}

bool is_png(const fs::path& path) { return extension_of(path) == ".png"; }

bool is_exr(const fs::path& path) { return extension_of(path) == ".exr"; }

bool holds_exr(const fs::path& path) {
  std::error_code ignored;
  if (is_exr(path)) return true;
  if (!fs::is_regular_file(path, ignored)) return false;  // to read from a pipe would take it away
  constexpr std::array<char, 4> kMagic = {'\x76', '\x2f', '\x31', '\x01'};
  std::array<char, 4> bytes{};
  std::ifstream(path, std::ios::binary).read(bytes.data(), bytes.size());
  return bytes == kMagic;
}

}  // namespace limpid

#include "limpid/files/picture/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <exception>
#include <fstream>
#include <map>

#include "limpid/core/error.h"

#include "core/memory.h"
#include "files/file_handle.h"
#include "files/picture/byte_of.h"
#include "files/picture/formats.h"
#include "files/picture/jpeg.h"
#include "files/picture/png.h"
#include "files/picture/whole_image.h"
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

// Enough bytes to recognise a format.
std::string start_of(const FileHandle& file) {
  std::string bytes(8, '\0');
  bytes.resize(file.read(bytes.data(), bytes.size(), 0));
  return bytes;
}

// Common readers of DPX invent the pixels that a file lacks. Its header has the size of the file,
// in the byte order of its first four letters (SMPTE ST 268:2014, "File Format for Digital
// Moving-Picture Exchange"); 0 and all bits set mean that the size is unknown.
void check_dpx_size(const FileHandle& file) {
  std::array<char, 20> header{};
  const std::size_t got = file.read(header.data(), header.size(), 0);
  const std::string_view magic(header.data(), 4);
  if (got < header.size() || (magic != "SDPX" && magic != "XPDS")) return;
  if (magic == "XPDS") std::reverse(header.begin() + 16, header.end());
  std::uint32_t size = 0;
  for (int i = 16; i < 20; ++i) size = size << 8 | static_cast<unsigned char>(header[i]);
  if (size == ~0u || file.size() >= size) return;
  throw Error(file.path().string() + ": ends after " + std::to_string(file.size()) +
              " bytes: expected " + std::to_string(size));
}

// The same checks as the format module makes for other formats.
void check_header(const Samples& header, const std::string& name, const Limits& limits) {
  const std::int64_t pixels = std::int64_t{header.width} * header.height;
  const std::string size =
      name + ": " + std::to_string(header.width) + "x" + std::to_string(header.height) + " pixels";
  if (std::max(header.width, header.height) > limits.max_side) {
    throw Error(size + ": expected sides of at most " + std::to_string(limits.max_side));
  }
  if (pixels > limits.max_pixels) {
    throw Error(size + ": expected at most " + std::to_string(limits.max_pixels) + " in all");
  }
  if (header.channels > limits.max_channels) {
    throw Error(name + ": " + std::to_string(header.channels) + " channels: expected at most " +
                std::to_string(limits.max_channels));
  }
  const std::int64_t bytes = pixels * header.channels * std::int64_t{sizeof(float)};
  if (bytes > limits.max_memory) {
    throw Error(name + ": needs " + std::to_string(bytes) + " bytes of memory: expected at most " +
                std::to_string(limits.max_memory));
  }
  for (const std::int64_t offset : {header.x0, header.y0}) {
    if (std::max(offset, -offset) > limits.max_side) {
      throw Error(name + ": window starts at " + std::to_string(offset) + ": expected at most " +
                  std::to_string(limits.max_side) + " pixels off the display window");
    }
  }
}

ImageFile image_of(const Samples& samples) {
  static const std::vector<std::string> names[] = {
      {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  ImageFile image;
  image.window = {samples.x0, samples.y0, samples.x0 + samples.width, samples.y0 + samples.height};
  image.channels = names[samples.channels - 1];
  image.straight_alpha = samples.channels % 2 == 0;
  const auto largest = static_cast<float>(samples.largest);
  for (int c = 0; c < samples.channels; ++c) {
    const View<float> to = image.planes.emplace_back(image.window).view();
    std::size_t sample = c;
    for (int y = image.window.y0; y < image.window.y1; ++y) {
      for (int x = image.window.x0; x < image.window.x1; ++x, sample += samples.channels)
        to.at(x, y) = static_cast<float>(samples.at(sample)) / largest;
    }
  }
  return image;
}

// Data of the callback of one read; an exception waits here until the C code has returned.
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
    static_cast<std::string*>(host)->assign(from, size);
    return 0;
  } catch (...) {
    return 1;
  }
}

// Throws the failure of a format module's function as an Error.
void check_done(const fs::path& path, int result, const std::string& error) {
  if (result == 0) return;
  // Out of memory, its libraries report arbitrary errors.
  if (result == formats::kNoMemory || !has_memory(kPlentyOfMemory)) throw no_memory(path.string());
  throw Error(path.string() + ": " + error);
}

enum class Format { kPng, kJpeg, kTiff };

Format format_of(const fs::path& path) {
  static const std::map<std::string, Format> formats = {{".png", Format::kPng},
                                                        {".jpg", Format::kJpeg},
                                                        {".jpeg", Format::kJpeg},
                                                        {".tif", Format::kTiff},
                                                        {".tiff", Format::kTiff}};
  const auto found = formats.find(extension_of(path));
  if (found == formats.end()) {
    throw Error(path.string() + ": 8-bit pictures are written as .png, .jpg or .tif");
  }
  return found->second;
}

// By the format module.
std::string encode_tiff(const fs::path& path, Rect window, int channels,
                        const std::uint8_t* pixels) {
  std::string bytes;
  std::array<char, formats::kErrorSize> error{};
  const int result = formats::module(path.string())
                         .write8("tiff", window.width(), window.height(), channels, pixels, take,
                                 &bytes, error.data());
  check_done(path, result, error.data());
  return bytes;
}

std::string encode(const fs::path& path, Rect window, int channels, const std::uint8_t* pixels,
                   const std::map<std::string, std::string>& texts) {
  switch (format_of(path)) {
    case Format::kPng:
      return encode_png(window.width(), window.height(), channels, pixels, texts, path.string());
    case Format::kJpeg:
      if (channels != 3) throw Error(path.string() + ": jpeg has no alpha: expected 3 channels");
      return encode_jpeg(window.width(), window.height(), pixels, 98, path.string());
    case Format::kTiff:
      break;
  }
  return encode_tiff(path, window, channels, pixels);
}

}  // namespace

ImageFile read_image(const fs::path& path, const Limits& limits) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw Error(path.string() + ": no such file");
  if (!fs::is_regular_file(path, ignored)) throw Error(path.string() + ": expected a file");
  const FileHandle file(path);
  const std::string start = start_of(file);
  if (begins_as_png(start) || begins_as_jpeg(start)) {
    const auto decode = begins_as_png(start) ? decode_png : decode_jpeg;
    const auto check = [&](const Samples& header) { check_header(header, path.string(), limits); };
    return image_of(decode(file.all(limits.max_memory), path.string(), check));
  }
  check_dpx_size(file);
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
  AtomicFiles files;
  write_image8(files, path, planes, texts);
  files.commit();
}

void write_image8(AtomicFiles& files, const fs::path& path,
                  const std::vector<View<const float>>& planes,
                  const std::map<std::string, std::string>& texts) {
  format_of(path);  // refuses an unknown extension first
  if (planes.size() != 3 && planes.size() != 4) {
    throw Error(path.string() + ": " + std::to_string(planes.size()) + " planes: expected 3 or 4");
  }
  const Rect window = planes[0].window;
  for (const View<const float>& plane : planes) {
    if (plane.window != window || window.empty()) {
      throw Error(path.string() + ": expected planes of one window that is not empty");
    }
  }
  write_image8(files, path, window.size(), static_cast<int>(planes.size()),
               interleaved(planes).data(), texts);
}

void write_image8(AtomicFiles& files, const fs::path& path, Size size, int channels,
                  const std::uint8_t* pixels, const std::map<std::string, std::string>& texts) {
  files.add(path).write(encode(path, rect_of(size), channels, pixels, texts));
}

void expect_image8(const fs::path& path) {
  if (format_of(path) == Format::kTiff) formats::module(path.string());
}

std::map<std::string, std::string> read_image_texts(const fs::path& path) {
  const FileHandle file(path);
  if (!begins_as_png(start_of(file))) return {};
  return png_texts(file.all(Limits{}.max_memory), path.string());
}

bool is_png(const fs::path& path) { return extension_of(path) == ".png"; }

bool is_exr(const fs::path& path) { return extension_of(path) == ".exr"; }

bool holds_exr(const fs::path& path) {
  std::error_code ignored;
  if (is_exr(path)) return true;
  if (!fs::is_regular_file(path, ignored)) return false;  // reading from a pipe would consume it
  constexpr std::array<char, 4> kMagic = {'\x76', '\x2f', '\x31', '\x01'};
  std::array<char, 4> bytes{};
  std::ifstream(path, std::ios::binary).read(bytes.data(), bytes.size());
  return bytes == kMagic;
}

}  // namespace limpid

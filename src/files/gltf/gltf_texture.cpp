#include "files/gltf/gltf_texture.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "limpid/core/error.h"

#include "files/memory_budget.h"
#include "files/picture/png_inflated.h"
#include "files/picture/stb_image.h"
#include "files/picture/whole_file.h"

namespace limpid {
namespace {

using namespace std::string_view_literals;

struct Free {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

// IEC 61966-2-1 "sRGB", its transfer function.
double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// Interleaved RGBA integers of which `largest` is 1.
template <class T>
std::vector<float> linear_texels(const T* pixels, std::size_t count, int largest) {
  std::vector<float> linear(largest + 1);
  for (int i = 0; i <= largest; ++i) {
    linear[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / largest));
  }
  std::vector<float> texels(4 * count);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    texels[i] = i % 4 == 3 ? static_cast<float>(pixels[i]) / static_cast<float>(largest)
                           : linear[pixels[i]];
  }
  return texels;
}

// While it is decoded: four floats, as many integers of 16 bits, and what stb_image works with.
constexpr std::int64_t kBytesATexel = 32;

void check_size(int width, int height, const std::string& name, const Limits& limits) {
  const std::int64_t pixels = std::int64_t{width} * height;
  const std::string size = name + ": " + std::to_string(width) + "x" + std::to_string(height);
  if (width > limits.max_side || height > limits.max_side) {
    throw OverLimit(size + " pixels: expected sides of at most " + std::to_string(limits.max_side));
  }
  if (pixels > limits.max_pixels) {
    throw OverLimit(size + " pixels: expected at most " + std::to_string(limits.max_pixels));
  }
  if (pixels > limits.max_memory / kBytesATexel) {
    throw OverLimit(size + " pixels: expected at most " + std::to_string(limits.max_memory) +
                    " bytes for it and all before");
  }
}

// "is WebP, " where it is a known one.
std::string other_format(std::string_view bytes) {
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "is WebP, ";
  if (bytes.starts_with("\xABKTX 20\xBB"sv)) return "is KTX2, ";
  return "";
}

/// `what` is wrong with a picture, unless stb_image only had no memory.
[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  const std::string_view reason = stbi_failure_reason();
  if (reason == "outofmem") throw no_memory(name);
  throw Error(name + ": " + what + ": " + std::string(reason));
}

}  // namespace

ModelTexture decode_texture(std::string_view bytes, const std::string& name, const Limits& limits) {
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n"sv) && !bytes.starts_with("\xFF\xD8\xFF"sv)) {
    throw Error(name + ": " + other_format(bytes) + "expected a PNG or JPEG picture");
  }
  check_whole(bytes, name);
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  ModelTexture texture;
  int channels = 0;
  if (stbi_info_from_memory(data, size, &texture.width, &texture.height, &channels) == 0) {
    refuse(name, "not a picture that can be read");
  }
  check_size(texture.width, texture.height, name, limits);
  if (bytes.front() == '\x89') {
    // Four channels of 16 bits, and a byte a row, of which interlaced pictures have twice as many.
    const std::int64_t rows = 2 * std::int64_t{texture.height} + 8;
    check_inflated(bytes, 8 * std::int64_t{texture.width} * texture.height + rows, name);
  }
  const std::size_t count = static_cast<std::size_t>(texture.width) * texture.height;
  const auto decoded = [&](auto* pixels, int largest) {
    const std::unique_ptr<std::remove_pointer_t<decltype(pixels)>, Free> owner(pixels);
    if (!pixels) refuse(name, "is damaged");
    texture.rgba = linear_texels(pixels, count, largest);
  };
  int width = 0, height = 0;
  if (stbi_is_16_bit_from_memory(data, size) != 0) {
    decoded(stbi_load_16_from_memory(data, size, &width, &height, &channels, 4), 65535);
  } else {
    decoded(stbi_load_from_memory(data, size, &width, &height, &channels, 4), 255);
  }
  return texture;
}

}  // namespace limpid

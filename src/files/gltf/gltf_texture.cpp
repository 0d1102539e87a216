#include "files/gltf/gltf_texture.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "limpid/core/error.h"

#include "files/gltf/memory_budget.h"
#include "files/picture/jpeg.h"
#include "files/picture/png.h"

namespace limpid {
namespace {

using namespace std::string_view_literals;

// IEC 61966-2-1 "sRGB", its transfer function.
double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::vector<float> linear_texels(const Samples& samples) {
  std::vector<float> linear(samples.largest + 1);
  for (int i = 0; i <= samples.largest; ++i) {
    linear[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / samples.largest));
  }
  const bool gray = samples.channels < 3, alpha = samples.channels % 2 == 0;
  const std::size_t channels = samples.channels;
  std::vector<float> texels(std::size_t{4} * samples.width * samples.height);
  for (std::size_t i = 0, from = 0; i < texels.size(); i += 4, from += channels) {
    for (std::size_t c = 0; c < 3; ++c) texels[i + c] = linear[samples.at(from + (gray ? 0 : c))];
    texels[i + 3] = alpha ? static_cast<float>(samples.at(from + channels - 1)) /
                                static_cast<float>(samples.largest)
                          : 1.0f;
  }
  return texels;
}

// During decoding: four floats, as many integers of 16 bits, and the decoder's memory.
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

// "is WebP, " for a known format.
std::string other_format(std::string_view bytes) {
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "is WebP, ";
  if (bytes.starts_with("\xABKTX 20\xBB"sv)) return "is KTX2, ";
  return "";
}

}  // namespace

ModelTexture decode_texture(std::string_view bytes, const std::string& name, const Limits& limits) {
  if (!begins_as_png(bytes) && !begins_as_jpeg(bytes)) {
    throw Error(name + ": " + other_format(bytes) + "expected a PNG or JPEG picture");
  }
  const Samples samples = (begins_as_png(bytes) ? decode_png : decode_jpeg)(
      bytes, name,
      [&](const Samples& header) { check_size(header.width, header.height, name, limits); });
  return {samples.width, samples.height, linear_texels(samples)};
}

}  // namespace limpid

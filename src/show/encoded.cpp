#include "show/encoded.h"

#include "files/atomic_file.h"
#include "files/picture/png.h"
#include "files/picture/whole_image.h"

namespace limpid {

std::vector<std::uint8_t> rgb_of(const Shown& shown) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(shown.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < shown.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) rgb.push_back(shown.rgba[i + c]);
  }
  return rgb;
}

std::string png_of(const Shown& shown) {
  return encode_png(shown.size.width, shown.size.height, 3, rgb_of(shown).data(), {},
                    "a picture that is shown");
}

void write_shown(AtomicFiles& files, const std::filesystem::path& path, const Shown& shown,
                 const std::map<std::string, std::string>& texts) {
  write_image8(files, path, shown.size, 3, rgb_of(shown).data(), texts);
}

std::string base64(const std::string& bytes) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      three = three << 8 | (i + j < bytes.size() ? static_cast<std::uint8_t>(bytes[i + j]) : 0u);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += i + j > bytes.size() ? '=' : kLetters[three >> (18 - 6 * j) & 63];
    }
  }
  return text;
}

}  // namespace limpid

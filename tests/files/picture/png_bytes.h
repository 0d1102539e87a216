#pragma once
#include <cstdint>
#include <string>

/// PNG files made by hand, chunk by chunk (ISO 15948:2003), without compression.

namespace limpid::test {

inline std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 255);
  return bytes;
}

/// A chunk of four letters and data, with its length and checksum.
inline std::string png_chunk(const std::string& named) {
  std::uint32_t crc = ~0u;
  for (const char letter : named) {
    crc ^= static_cast<unsigned char>(letter);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return big_endian(static_cast<std::uint32_t>(named.size() - 4)) + named + big_endian(~crc);
}

/// A zlib stream of one stored block (RFC 1950, RFC 1951) of at most 65535 bytes.
inline std::string stored(const std::string& data) {
  const auto size = static_cast<std::uint32_t>(data.size());
  std::uint32_t a = 1, b = 0;
  for (const char byte : data) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const std::string length{static_cast<char>(size), static_cast<char>(size >> 8),
                           static_cast<char>(~size), static_cast<char>(~size >> 8)};
  return "\x78\x01\x01" + length + data + big_endian(b << 16 | a);
}

/// What is around the pixels and in the header; `more` are chunks between the two.
struct PngKind {
  std::uint32_t width = 1, height = 1;
  char bits = 8;
  char color = 6;  ///< 0 gray, 2 RGB, 3 palette, 4 gray and alpha, 6 RGB and alpha
  char interlaced = 0;
  std::string more = {};
};

/// `data` is what the chunk IDAT has.
inline std::string png_file(const PngKind& kind, const std::string& data) {
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR" + big_endian(kind.width) + big_endian(kind.height) + kind.bits +
                   kind.color + std::string(2, '\0') + kind.interlaced) +
         kind.more + png_chunk("IDAT" + data) + png_chunk("IEND");
}

}  // namespace limpid::test

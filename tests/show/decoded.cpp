#include "show/decoded.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

#include <gtest/gtest.h>

#include "limpid/files/picture/image_file.h"

#include "files/picture/png.h"

namespace limpid::test {
namespace {

std::string bytes_of(const std::string& letters) {
  const std::string known = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char letter : letters) {
    const std::size_t value = known.find(letter);
    if (value == known.npos) break;  // the padding
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  return bytes;
}

Decoded decoded_png_of(const std::string& letters) {
  const Samples samples = decode_png(bytes_of(letters), "terminal", [](const Samples&) {});
  EXPECT_EQ(samples.channels, 3);
  return {{samples.width, samples.height}, samples.bytes};
}

/// Reads a number and moves `at` behind the number.
int number_at(const std::string& text, std::size_t& at) {
  const std::size_t end = text.find_first_not_of("0123456789", at);
  const int number = std::atoi(text.substr(at, end - at).c_str());
  at = end;
  return number;
}

}  // namespace

Decoded decoded_kitty(const std::string& text) {
  std::string letters;
  bool more = true, first = true;
  for (std::size_t at = text.find("\x1b_G"); more; at = text.find("\x1b_G", at + 1)) {
    if (at == text.npos) {
      ADD_FAILURE() << "the last part is missing";
      return {};
    }
    const std::size_t semicolon = text.find(';', at), end = text.find("\x1b\\", at);
    const std::string keys = text.substr(at + 3, semicolon - at - 3);
    EXPECT_EQ(keys.find("a=T,f=100,") != keys.npos, first) << keys;
    EXPECT_LE(end - semicolon - 1, 4096);
    letters += text.substr(semicolon + 1, end - semicolon - 1);
    more = keys.find("m=1") != keys.npos;
    first = false;
  }
  return decoded_png_of(letters);
}

Decoded decoded_iterm(const std::string& text) {
  const std::string begin = "\x1b]1337;File=inline=1;size=";
  const std::size_t at = text.find(begin), colon = text.find(':', at), end = text.find('\a', at);
  if (at == text.npos || end == text.npos) {
    ADD_FAILURE() << "no inline image";
    return {};
  }
  const std::string letters = text.substr(colon + 1, end - colon - 1);
  EXPECT_EQ(std::atoi(text.c_str() + at + begin.size()), bytes_of(letters).size());
  return decoded_png_of(letters);
}

Decoded decoded_sixel(const std::string& text) {
  Decoded picture;
  std::size_t at = text.find("\x1bP0;1;0q\"1;1;");
  if (at == text.npos) {
    ADD_FAILURE() << "no sixels";
    return {};
  }
  at = text.find("\"1;1;", at) + 5;
  picture.size.width = number_at(text, at);
  picture.size.height = number_at(text, ++at);
  picture.rgb.assign(std::size_t{3} * picture.size.width * picture.size.height, 0);
  std::map<int, std::array<int, 3>> palette;
  std::vector<bool> drawn(picture.rgb.size() / 3);
  int color = -1, x = 0, y0 = 0;
  const auto draw = [&](int count, int points) {
    for (; count > 0; --count, ++x) {
      for (int i = 0; i < 6; ++i) {
        if ((points >> i & 1) == 0) continue;
        if (x >= picture.size.width || y0 + i >= picture.size.height) {
          ADD_FAILURE() << "a point outside the picture";
          return;
        }
        const auto pixel = static_cast<std::size_t>(y0 + i) * picture.size.width + x;
        drawn[pixel] = true;
        for (std::size_t c = 0; c < 3; ++c) {
          picture.rgb[3 * pixel + c] =
              static_cast<std::uint8_t>((255 * palette.at(color)[c] + 50) / 100);
        }
      }
    }
  };
  while (text.compare(at, 2, "\x1b\\") != 0) {
    const char letter = text[at++];
    if (letter == '#') {
      color = number_at(text, at);
      if (text[at] != ';') continue;
      EXPECT_EQ(number_at(text, ++at), 2) << "no red, green, blue";
      for (int& part : palette[color]) part = number_at(text, ++at);
    } else if (letter == '!') {
      const int count = number_at(text, at);
      draw(count, text[at++] - '?');
    } else if (letter == '$') {
      x = 0;
    } else if (letter == '-') {
      x = 0;
      y0 += 6;
    } else {
      draw(1, letter - '?');
    }
  }
  EXPECT_LE(palette.size(), 256);
  EXPECT_EQ(std::count(drawn.begin(), drawn.end(), false), 0) << "pixels are not drawn";
  return picture;
}

Decoded decoded_file(const std::filesystem::path& path) {
  const ImageFile image = read_image(path);
  Decoded bytes{image.window.size(), {}};
  for (int y = image.window.y0; y < image.window.y1; ++y) {
    for (int x = image.window.x0; x < image.window.x1; ++x) {
      for (int c = 0; c < 3; ++c) {
        bytes.rgb.push_back(
            static_cast<std::uint8_t>(255 * image.planes[c].view().at(x, y) + 0.5f));
      }
    }
  }
  return bytes;
}

Apart apart(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  Apart apart;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const int by = std::abs(int{a[i]} - int{b[i]});
    apart.mean += by;
    apart.most = std::max(apart.most, by);
  }
  apart.mean /= static_cast<double>(a.size());
  return apart;
}

}  // namespace limpid::test

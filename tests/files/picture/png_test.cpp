#include "files/picture/png.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "files/picture/png_bytes.h"

namespace limpid {
namespace {

using namespace std::string_literals;
using test::png_chunk;
using test::png_file;
using test::PngKind;
using test::stored;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Samples decoded(const std::string& bytes) {
  return decode_png(bytes, "a.png", [](const Samples& header) {
    if (std::max(header.width, header.height) > 100) throw Error("too large");
  });
}

std::string refusal(const std::string& bytes) {
  try {
    decoded(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "not refused";
}

std::vector<int> values(const Samples& samples) {
  std::vector<int> all;
  const std::size_t count = std::size_t{1} * samples.width * samples.height * samples.channels;
  for (std::size_t i = 0; i < count; ++i) all.push_back(samples.at(i));
  return all;
}

TEST(Png, ScalesGraysAndTakesTheTransparentOne) {
  const PngKind kind{.width = 4, .bits = 4, .color = 0, .more = png_chunk("tRNS\0\x0B"s)};
  const Samples samples = decoded(png_file(kind, stored("\0\x1B\xF0"s)));
  EXPECT_EQ(samples.channels, 2);
  EXPECT_EQ(samples.largest, 255);
  EXPECT_THAT(values(samples), ElementsAre(17, 255, 187, 0, 255, 255, 0, 255));
}

TEST(Png, PalettesBecomeColor) {
  PngKind kind{
      .width = 4, .bits = 2, .color = 3, .more = png_chunk("PLTE\1\2\3\4\5\6\7\10\11\12\13\14")};
  EXPECT_THAT(values(decoded(png_file(kind, stored("\0\x1B"s)))),
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
  kind.more += png_chunk("tRNS\x10");
  EXPECT_THAT(values(decoded(png_file(kind, stored("\0\x1B"s)))),
              ElementsAre(1, 2, 3, 16, 4, 5, 6, 255, 7, 8, 9, 255, 10, 11, 12, 255));
}

TEST(Png, SixteenBitsAreOfThisMachine) {
  const Samples samples =
      decoded(png_file({.bits = 16, .color = 4}, stored("\0\x12\x34\x56\x78"s)));
  EXPECT_EQ(samples.largest, 65535);
  EXPECT_THAT(values(samples), ElementsAre(0x1234, 0x5678));
}

TEST(Png, InterlacedRowsComeTogether) {
  constexpr int kSide = 9, kPasses[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                            {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
  std::string data;
  for (const auto& [x0, y0, dx, dy] : kPasses) {
    for (int y = y0; y < kSide; y += dy) {
      data += '\0';
      for (int x = x0; x < kSide; x += dx) data += static_cast<char>(kSide * y + x);
    }
  }
  const std::vector<int> got = values(decoded(
      png_file({.width = kSide, .height = kSide, .color = 0, .interlaced = 1}, stored(data))));
  for (int i = 0; i < kSide * kSide; ++i) EXPECT_EQ(got.at(i), i);
}

TEST(Png, OffsetsInPixelsAreTaken) {
  const auto at = [](char unit) {
    const std::string chunk = png_chunk("oFFs\0\0\0\3\xFF\xFF\xFF\xFC"s + unit);
    return decoded(png_file({.color = 0, .more = chunk}, stored("\0\1"s)));
  };
  EXPECT_EQ(at(0).x0, 3);
  EXPECT_EQ(at(0).y0, -4);
  EXPECT_EQ(at(1).x0, 0);  // micrometres
}

// Broken, large or many: what is no pixel is not looked at, but for its checksum.
TEST(Png, OtherChunksDoNotMatter) {
  std::string more = png_chunk("iCCPnone\0\0no profile"s) + png_chunk("gAMA") +
                     png_chunk("zTXt" + std::string(1 << 20, 'z'));
  for (int i = 0; i < 2000; ++i) more += png_chunk("tEXtkey\0text"s);
  const PngKind kind{.color = 0, .more = more};
  const std::string file = png_file(kind, stored("\0\1"s));
  EXPECT_THAT(values(decoded(file)), ElementsAre(1));
  std::string damaged = file;
  damaged[file.find("text")] = 'T';
  EXPECT_EQ(refusal(damaged), "a.png: is damaged: wrong checksum of a chunk tEXt");
}

TEST(Png, TruncatedFilesAreRefusedWhereverTheyEnd) {
  const std::string whole =
      png_file({.width = 2, .color = 0, .more = png_chunk("tEXtkey\0text"s)}, stored("\0\1\2"s));
  EXPECT_THAT(values(decoded(whole)), ElementsAre(1, 2));
  for (std::size_t size = 8; size < whole.size(); ++size) {
    EXPECT_EQ(refusal(whole.substr(0, size)),
              "a.png: ends too early: expected the rest of its pixels")
        << size;
  }
  EXPECT_THAT(values(decoded(whole + "more")), ElementsAre(1, 2));
}

TEST(Png, EveryFlippedBitOfThePixelsIsSeen) {
  const std::string whole = png_file({.width = 2, .color = 0}, stored("\0\1\2"s));
  const std::size_t begin = whole.find("IDAT");
  for (std::size_t at = begin; at < whole.size() - 12; ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = whole;
      flipped[at] = static_cast<char>(flipped[at] ^ 1 << bit);
      EXPECT_THAT(refusal(flipped), HasSubstr("a.png: is damaged: ")) << at << ' ' << bit;
    }
  }
}

TEST(Png, PixelsAreNeitherFewerNorMoreThanTheSizeSays) {
  EXPECT_THAT(refusal(png_file({.height = 2, .color = 0}, stored("\0\1"s))),
              HasSubstr("a.png: is damaged: "));
  EXPECT_EQ(refusal(png_file({.color = 0}, stored("\0\1"s + std::string(60000, '\0')))),
            "a.png: is damaged: its pixels decompress to more than its size allows");
}

TEST(Png, TheHeaderIsCheckedBeforeThereIsMemory) {
  EXPECT_EQ(refusal(png_file({.width = 0x7FFFFFFF, .height = 0x7FFFFFFF}, "")), "too large");
  EXPECT_THAT(refusal(png_file({.width = 0x80000000}, "")), HasSubstr("is damaged"));
  EXPECT_THAT(refusal(png_file({.width = 0}, "")), HasSubstr("is damaged"));
}

TEST(Png, AreSmallAndSayTheirColorSpace) {
  const std::vector<std::uint8_t> pixels(3 * 256 * 256, 77);
  const std::string file = encode_png(256, 256, 3, pixels.data(), {}, "a.png");
  EXPECT_LT(file.size(), pixels.size() / 50);
  EXPECT_THAT(file, HasSubstr("sRGB"));
  EXPECT_THAT(file, Not(HasSubstr("tIME")));
}

}  // namespace
}  // namespace limpid

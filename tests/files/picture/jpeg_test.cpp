#include "files/picture/jpeg.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <jpeglib.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

using namespace std::string_literals;
using ::testing::HasSubstr;

constexpr int kSide = 48;

std::string ramps() {
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < kSide * kSide; ++i) {
    for (const int value : {5 * (i % kSide), 5 * (i / kSide), 77})
      rgb.push_back(static_cast<std::uint8_t>(value));
  }
  return encode_jpeg(kSide, kSide, rgb.data(), 98, "a.jpg");
}

Samples decoded(const std::string& bytes) {
  return decode_jpeg(bytes, "a.jpg", [](const Samples& header) {
    if (header.width > 1000) throw Error("too large");
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

TEST(Jpeg, ComesBackNearly) {
  const Samples samples = decoded(ramps());
  ASSERT_EQ(samples.channels, 3);
  ASSERT_EQ(samples.bytes.size(), 3 * kSide * kSide);
  for (int i = 0; i < kSide * kSide; ++i) {
    EXPECT_NEAR(samples.at(3 * i), 5 * (i % kSide), 6) << i;
    EXPECT_NEAR(samples.at(3 * i + 1), 5 * (i / kSide), 6) << i;
    EXPECT_NEAR(samples.at(3 * i + 2), 77, 8) << i;
  }
}

TEST(Jpeg, TruncatedFilesAreRefusedWhereverTheyEnd) {
  const std::string whole = ramps();
  for (std::size_t size = 3; size < whole.size(); ++size) {
    EXPECT_EQ(refusal(whole.substr(0, size)),
              "a.jpg: ends too early: expected the rest of its pixels")
        << size;
  }
}

// libjpeg itself would make up what is missing, and warn.
TEST(Jpeg, PixelsAreNotMadeUp) {
  const std::string whole = ramps();
  const std::size_t middle = whole.size() * 3 / 4;
  EXPECT_THAT(refusal(whole.substr(0, middle) + "\xFF\xD9"),
              HasSubstr("a.jpg: cannot be decoded: Corrupt JPEG data: premature end"));
  std::string ones = whole;
  for (int i = 0; i < 20; ++i) ones.replace(middle + 2 * i, 2, "\xFF\0"s);
  EXPECT_THAT(refusal(ones), HasSubstr("a.jpg: cannot be decoded: Corrupt JPEG data: "));
}

TEST(Jpeg, TheHeaderIsCheckedFirst) {
  std::string large = ramps();
  large.replace(large.find("\xFF\xC0"s) + 7, 2, "\xFF\x00"s);  // its width
  EXPECT_EQ(refusal(large), "too large");
  large.replace(large.find("\xFF\xC0"s) + 7, 2, "\xFF\xFF"s);
  EXPECT_THAT(refusal(large), HasSubstr("65500"));
}

// One that repeats a scan of all its zero frequencies.
TEST(Jpeg, ScansHaveAnEnd) {
  const std::vector<std::uint8_t> black(3 * 16 * 16);
  std::string head = encode_jpeg(16, 16, black.data(), 90, "a.jpg");
  head.resize(head.find("\xFF\xDA"s));
  head[head.find("\xFF\xC0"s) + 1] = '\xC2';  // progressive
  const std::string scan =
      "\xFF\xDA\0\x0C\3\1\0\2\x11\3\x11\0\0\0"  // three channels, coefficient 0
      "\0\x0F"s;                                // six times the code 00, then ones
  const auto file = [&](int scans) {
    std::string bytes = head;
    for (int i = 0; i < scans; ++i) bytes += scan;
    return bytes + "\xFF\xD9";
  };
  EXPECT_EQ(decoded(file(400)).width, 16);
  EXPECT_EQ(refusal(file(600)), "a.jpg: cannot be decoded: it has more than 500 scans");
}

// By libjpeg, which has a marker of Adobe for them, at full quality.
std::string four_inks(const std::uint8_t (&inks)[4]) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &memory, &size);
  jpeg.image_width = jpeg.image_height = 8;
  jpeg.input_components = 4;
  jpeg.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> row;
  for (int x = 0; x < 8; ++x) row.insert(row.end(), inks, inks + 4);
  for (int y = 0; y < 8; ++y) {
    JSAMPROW pixels = row.data();
    jpeg_write_scanlines(&jpeg, &pixels, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  const std::string bytes(reinterpret_cast<char*>(memory), size);
  std::free(memory);
  return bytes;
}

TEST(Jpeg, FourInksBecomeColor) {
  const Samples samples = decoded(four_inks({200, 100, 50, 128}));
  ASSERT_EQ(samples.channels, 3);
  EXPECT_NEAR(samples.at(0), 200 * 128 / 255., 1.5);
  EXPECT_NEAR(samples.at(1), 100 * 128 / 255., 1.5);
  EXPECT_NEAR(samples.at(2), 50 * 128 / 255., 1.5);
}

}  // namespace
}  // namespace limpid

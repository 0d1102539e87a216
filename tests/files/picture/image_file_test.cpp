#include "limpid/files/picture/image_file.h"

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "limpid/core/error.h"

#include "memory_end.h"
#include "paths.h"
#include "sanitized.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const fs::path kData = fs::path(LIMPID_TEST_DATA) / "formats";

// An empty folder for one test.
fs::path scratch() {
  const fs::path folder =
      fs::path(testing::TempDir()) /
      (std::string("limpid_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

// The sentence of the Error that the work throws.
template <class Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "not refused";
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// Planes with k / 255 in each pixel, k running through 0 ... 255 without a pattern.
std::vector<Plane> noise(Rect window, int count) {
  std::vector<Plane> planes;
  unsigned state = 1;
  for (int c = 0; c < count; ++c) {
    const View<float> view = planes.emplace_back(window).view();
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        state = state * 1664525u + 1013904223u;
        view.at(x, y) = static_cast<float>(state >> 24) / 255.0f;
      }
    }
  }
  return planes;
}

std::vector<View<const float>> views(const std::vector<Plane>& planes) {
  std::vector<View<const float>> all;
  for (const Plane& plane : planes) all.push_back(plane.view());
  return all;
}

TEST(ImageFile, ReadsBackEveryByteThatItWrote) {
  const fs::path folder = scratch();
  const Rect window{2, 1, 39, 68};
  for (const char* name : {"a.png", "a.tif", "A.TIFF"}) {
    for (int count : {3, 4}) {
      const std::vector<Plane> planes = noise(window, count);
      write_image8(folder / name, views(planes));
      const ImageFile image = read_image(folder / name);
      EXPECT_EQ(image.window, rect_of(window.size()));
      EXPECT_EQ(image.straight_alpha, count == 4);
      ASSERT_EQ(image.planes.size(), count);
      for (int c = 0; c < count; ++c) {
        EXPECT_EQ(image.channels[c], std::string(1, "RGBA"[c]));
        for (int y = 0; y < window.height(); ++y) {
          for (int x = 0; x < window.width(); ++x) {
            ASSERT_EQ(image.planes[c].view().at(x, y), planes[c].view().at(x + 2, y + 1))
                << name << " channel " << c << " at " << x << ", " << y;
          }
        }
      }
    }
  }
}

TEST(ImageFile, ClampsAndRoundsAndTakesAnyStride) {
  const float inf = std::numeric_limits<float>::infinity();
  const float pixels[] = {-1.0f,         2.0f,          std::nanf(""), inf, -inf, 0.5f,
                          100.49f / 255, 100.51f / 255, 254.6f / 255,  0,   1,    1e-9f};
  std::vector<View<const float>> planes;
  for (int c = 0; c < 3; ++c) planes.push_back({pixels + c, 3, 6, {0, 0, 2, 2}});
  const fs::path path = scratch() / "a.png";
  write_image8(path, planes);
  const ImageFile image = read_image(path);
  std::vector<float> codes;
  for (int i = 0; i < 12; ++i) {
    codes.push_back(255 * image.planes[i % 3].view().at(i / 3 % 2, i / 6));
  }
  EXPECT_THAT(codes, ElementsAre(0, 255, 0, 255, 0, 128, 100, 101, 255, 0, 255, 0));
}

TEST(ImageFile, WritesJpegWithoutAlphaOnly) {
  const fs::path path = scratch() / "a.jpg";
  std::vector<Plane> planes;
  for (float value : {0.8f, 0.4f, 0.2f, 1.0f}) {
    const View<float> view = planes.emplace_back(Rect{0, 0, 16, 16}).view();
    for (int y = 0; y < 16; ++y) std::fill_n(view.row(y), 16, value);
  }
  EXPECT_THAT(refusal([&] { write_image8(path, views(planes)); }), HasSubstr("no alpha"));
  EXPECT_FALSE(fs::exists(path));
  planes.pop_back();
  write_image8(path, views(planes));
  const ImageFile image = read_image(path);
  EXPECT_NEAR(image.planes[0].view().at(7, 7), 0.8f, 0.01f);
  EXPECT_NEAR(image.planes[1].view().at(7, 7), 0.4f, 0.01f);
  EXPECT_NEAR(image.planes[2].view().at(7, 7), 0.2f, 0.01f);
}

TEST(ImageFile, BytesDependOnTheArgumentsAlone) {
  const fs::path folder = scratch();
  const std::vector<Plane> planes = noise({0, 0, 7, 5}, 3);
  for (const char* extension : {".png", ".jpg", ".tif"}) {
    write_image8(folder / (std::string("one") + extension), views(planes));
    write_image8(folder / (std::string("other") + extension), views(planes));
    EXPECT_EQ(bytes_of(folder / (std::string("one") + extension)),
              bytes_of(folder / (std::string("other") + extension)));
  }
  EXPECT_THAT(bytes_of(folder / "one.tif"), HasSubstr("1970:01:01 00:00:00"));
}

TEST(ImageFile, APngCarriesTexts) {
  const fs::path folder = scratch();
  const std::vector<Plane> planes = noise({0, 0, 9, 7}, 3);
  const std::map<std::string, std::string> texts{
      {"limpid/key", "one line"}, {"limpid/many", "lines\nand \xC3\xBC\n"}, {"limpid/none", ""}};
  std::map<std::string, std::string> all = texts;
  all.insert({{"limpid", "not ours"}, {"Title", "nor this"}});
  write_image8(folder / "a.PNG", views(planes), all);
  EXPECT_EQ(read_image_texts(folder / "a.PNG"), texts);
  write_image8(folder / "plain.png", views(planes));
  EXPECT_TRUE(read_image_texts(folder / "plain.png").empty());
  EXPECT_GT(bytes_of(folder / "a.PNG").size(), bytes_of(folder / "plain.png").size());
  const ImageFile with = read_image(folder / "a.PNG"), without = read_image(folder / "plain.png");
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(with.planes[c].view().at(8, 6), without.planes[c].view().at(8, 6));
  }
  for (const char* name : {"a.jpg", "a.tif"}) {  // have no place for them
    write_image8(folder / name, views(planes), texts);
    EXPECT_TRUE(read_image_texts(folder / name).empty());
  }
  for (const std::string& key : {std::string(), std::string(80, 'k'), std::string("two words")}) {
    EXPECT_THAT(refusal([&] {
                  write_image8(folder / "b.png", views(planes), {{key, ""}});
                }),
                HasSubstr("expected a name of 1 ... 79 letters of ASCII"));
  }
  EXPECT_FALSE(fs::exists(folder / "b.png"));
}

TEST(ImageFile, TextsOfEarlierVersionsAreRead) {
  const std::map<std::string, std::string> texts = read_image_texts(kData / "texts.png");
  EXPECT_EQ(texts.size(), 7);
  EXPECT_EQ(texts.at("limpid/version"), "0.1.0");
  EXPECT_THAT(texts.at("limpid/look"), HasSubstr("[depth_fog]\nmodel = \"linear\"\n"));
}

TEST(ImageFile, TextsOfADamagedPngAreRefused) {
  const fs::path folder = scratch();
  write_image8(folder / "a.png", views(noise({0, 0, 9, 7}, 3)), {{"limpid/key", "text"}});
  const std::string whole = bytes_of(folder / "a.png");
  for (std::size_t size = 8; size < whole.size(); ++size) {
    write_bytes(folder / "cut.png", whole.substr(0, size));
    EXPECT_THROW(read_image_texts(folder / "cut.png"), Error) << size;
  }
  std::string damaged = whole;
  damaged[whole.find("text")] = 'T';
  write_bytes(folder / "bad.png", damaged);
  EXPECT_THAT(refusal([&] { read_image_texts(folder / "bad.png"); }), HasSubstr("checksum"));
  EXPECT_THROW(read_image_texts(folder / "none.png"), Error);
}

// Chunks that a picture may have without end: a key that is not ours, empty ones, and what follows
// the end of the picture.
TEST(ImageFile, TextsBetweenWhateverElseThereIs) {
  const fs::path folder = scratch();
  const std::map<std::string, std::string> texts{{"limpid/a", "1"}, {"limpid/b", "2"}};
  const std::vector<Plane> planes = noise({0, 0, 9, 7}, 3);
  write_image8(folder / "a.png", views(planes), {{"limpid/a", "1"}});
  write_image8(folder / "b.png", views(planes), {{"limpid/b", "2"}});
  write_image8(folder / "x.png", views(planes), {{"limpix", std::string(1000000, 'x')}});
  constexpr std::size_t kHeader = 8 + 25 + 13;  // signature, IHDR and sRGB
  const std::string plain = [&] {
    write_image8(folder / "plain.png", views(planes));
    return bytes_of(folder / "plain.png");
  }();
  const auto chunks = [&](const char* name) {
    const std::string bytes = bytes_of(folder / name);
    return bytes.substr(kHeader, bytes.size() - plain.size());
  };
  const std::string foreign = chunks("x.png") + chunks("x.png");
  std::string empty;
  for (int i = 0; i < 100000; ++i)
    empty += std::string(
        "\0\0\0\0tEXt"
        "\x96\x42\xC5\x85",
        12);
  write_bytes(folder / "all.png", plain.substr(0, kHeader) + chunks("a.png") + foreign + empty +
                                      chunks("b.png") + plain.substr(kHeader) +
                                      std::string(1 << 20, '\0') + chunks("b.png"));
  EXPECT_EQ(read_image_texts(folder / "all.png"), texts);
  write_bytes(folder / "late.png", plain + chunks("a.png"));
  EXPECT_TRUE(read_image_texts(folder / "late.png").empty());
}

TEST(ImageFile, TextsOfMoreThanAMegabyteAreRefused) {
  const fs::path folder = scratch();
  const std::vector<Plane> planes = noise({0, 0, 9, 7}, 3);
  std::map<std::string, std::string> texts{{"limpid/a", std::string(500000, 'a')},
                                           {"limpid/b", std::string(500000, 'b')}};
  write_image8(folder / "a.png", views(planes), texts);
  EXPECT_EQ(read_image_texts(folder / "a.png"), texts);
  const std::string whole = bytes_of(folder / "a.png");
  const std::size_t first = whole.find("iTXt") - 4, size = 12 + 8 + 5 + 500000;
  write_bytes(folder / "b.png", whole.substr(0, first + size) + whole.substr(first));
  EXPECT_EQ(
      refusal([&] { read_image_texts(folder / "b.png"); }),
      (folder / "b.png").string() + ": records of how it was made: expected at most 1 MiB of text");
  texts["limpid/c"] = texts["limpid/b"];
  EXPECT_THAT(refusal([&] { write_image8(folder / "c.png", views(planes), texts); }),
              HasSubstr("expected at most 1 MiB"));
  EXPECT_FALSE(fs::exists(folder / "c.png"));
}

TEST(ImageFile, LeavesTheOldFileAndNothingElseWhenWritingFails) {
  const fs::path folder = scratch();
  write_bytes(folder / "a.jpg", "old");
  EXPECT_THROW(write_image8(folder / "a.jpg", views(noise({0, 0, 4, 4}, 4))), Error);
  EXPECT_EQ(bytes_of(folder / "a.jpg"), "old");
  fs::create_directory(folder / "b.png");
  const std::vector<Plane> planes = noise({0, 0, 4, 4}, 3);
  EXPECT_THROW(write_image8(folder / "b.png", views(planes)), Error);
  EXPECT_THAT(refusal([&] { write_image8(folder / "none" / "c.png", views(planes)); }),
              HasSubstr("no such file"));
  write_image8(folder / "a.jpg", views(planes));
  EXPECT_NE(bytes_of(folder / "a.jpg"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);
}

TEST(ImageFile, RefusesWhatItCannotWrite) {
  const fs::path folder = scratch();
  const std::vector<Plane> planes = noise({0, 0, 4, 4}, 3), larger = noise({0, 0, 5, 4}, 3);
  for (const char* name : {"a.exr", "a.gif", "a", ".png"}) {
    EXPECT_THAT(refusal([&] { write_image8(folder / name, views(planes)); }),
                HasSubstr(".png, .jpg or .tif"));
  }
  auto write = [&](std::vector<View<const float>> all) {
    return refusal([&] { write_image8(folder / "a.png", all); });
  };
  EXPECT_THAT(write({}), HasSubstr("0 planes: expected 3 or 4"));
  EXPECT_THAT(write({planes[0].view()}), HasSubstr("1 planes: expected 3 or 4"));
  EXPECT_THAT(write({planes[0].view(), planes[1].view(), larger[2].view()}),
              HasSubstr("one window"));
  EXPECT_THAT(write({{}, {}, {}}), HasSubstr("not empty"));
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(ImageFile, DividesIntegersByTheirLargestValue) {
  const ImageFile grey = read_image(kData / "grey16.png");
  EXPECT_THAT(grey.channels, ElementsAre("Y"));
  EXPECT_EQ(grey.window, (Rect{0, 0, 2, 1}));
  EXPECT_FALSE(grey.straight_alpha);
  EXPECT_EQ(grey.planes[0].view().at(0, 0), 16384.0f / 65535.0f);
  EXPECT_EQ(grey.planes[0].view().at(1, 0), 1.0f);
  const ImageFile ten_bits = read_image(kData / "ten_bits.dpx");
  EXPECT_EQ(ten_bits.planes[0].view().at(3, 2), 1.0f);
  EXPECT_NEAR(ten_bits.planes[1].view().at(3, 2), 512.0f / 1023.0f, 1e-5f);
}

TEST(ImageFile, KeepsFloatsUnboundedAndTheDataWindow) {
  EXPECT_EQ(read_image(kData / "bright.hdr").planes[1].view().at(2, 2), 4.0f);
  const ImageFile tiled = read_image(kData / "tiled.tif");
  EXPECT_EQ(tiled.window, (Rect{2, 1, 32, 31}));
  // A gradient over 20x20 pixels from (3, 2) on, black around it; tiles of 16x16.
  EXPECT_EQ(tiled.planes[0].view().at(2, 1), 0.0f);
  EXPECT_EQ(tiled.planes[0].view().at(22, 2), 8.0f);
  EXPECT_EQ(tiled.planes[0].view().at(3, 21), 0.0f);
  EXPECT_EQ(tiled.planes[1].view().at(3, 21), 4.0f);
  EXPECT_EQ(tiled.planes[2].view().at(22, 21), 3.0f);
  EXPECT_EQ(tiled.planes[2].view().at(23, 21), 0.0f);
  EXPECT_NEAR(tiled.planes[0].view().at(19, 10), 8 * 16 / 19.0f, 1e-5f);
}

TEST(ImageFile, RefusesWhatIsNoPicture) {
  const fs::path folder = scratch();
  EXPECT_THAT(refusal([&] { read_image(folder / "none.png"); }), HasSubstr("no such file"));
  EXPECT_THAT(refusal([&] { read_image(folder); }), HasSubstr("expected a file"));
  for (const char* name : {"empty.png", "empty", "empty.jpg"}) {
    write_bytes(folder / name, "");
    EXPECT_THROW(read_image(folder / name), Error) << name;
  }
  write_bytes(folder / "text.png", "not a picture");
  EXPECT_THAT(refusal([&] { read_image(folder / "text.png"); }), HasSubstr("text.png: "));
  // OpenImageIO would make up black pixels for this one.
  write_bytes(folder / "a.null", "x");
  EXPECT_THAT(refusal([&] { read_image(folder / "a.null"); }),
              HasSubstr("its format is null: expected one of bmp, "));
}

TEST(ImageFile, RefusesDamagedPixels) {
  const fs::path folder = scratch();
  for (const char* name : {"a.png", "a.jpg", "a.tif"}) {
    write_image8(folder / name, views(noise({0, 0, 150, 131}, 3)));
    const std::string whole = bytes_of(folder / name);
    for (std::size_t share : {1, 30, 60, 90}) {
      write_bytes(folder / name, whole.substr(0, whole.size() * share / 100));
      EXPECT_THAT(refusal([&] { read_image(folder / name); }), HasSubstr(name)) << share << "%";
    }
  }
  // OpenImageIO reports success for the first rows of these, with an error on the side.
  for (const char* name : {"bright.hdr", "ten_bits.dpx", "tiled.tif", "float_strips.tif"}) {
    const std::string whole = bytes_of(kData / name);
    ASSERT_GT(whole.size(), 0) << name;
    write_bytes(folder / name, whole.substr(0, whole.size() - whole.size() / 10));
    EXPECT_EQ(refusal([&] { read_image(kData / name); }), "not refused");
    EXPECT_THAT(refusal([&] { read_image(folder / name); }), HasSubstr(name));
  }
  const std::string dpx = bytes_of(kData / "ten_bits.dpx");
  write_bytes(folder / "a.dpx", dpx.substr(0, dpx.size() - 1));
  EXPECT_THAT(refusal([&] { read_image(folder / "a.dpx"); }),
              HasSubstr("ends after 8239 bytes: expected 8240"));
  write_image8(folder / "b.png", views(noise({0, 0, 150, 131}, 3)));
  std::string flipped = bytes_of(folder / "b.png");
  flipped[flipped.size() / 2] ^= 0x10;
  write_bytes(folder / "b.png", flipped);
  EXPECT_THAT(refusal([&] { read_image(folder / "b.png"); }), HasSubstr("is damaged: "));
}

TEST(ImageFile, ChecksTheLimitsBeforeThePixels) {
  const fs::path path = scratch() / "a.png";
  write_image8(path, views(noise({0, 0, 10, 4}, 3)));
  auto refused = [&](Limits limits) { return refusal([&] { read_image(path, limits); }); };
  EXPECT_EQ(refused({.max_pixels = 40, .max_side = 10, .max_channels = 3, .max_memory = 480}),
            "not refused");
  EXPECT_THAT(refused({.max_pixels = 39}), HasSubstr("10x4 pixels: expected at most 39"));
  EXPECT_THAT(refused({.max_side = 9}), HasSubstr("expected sides of at most 9"));
  EXPECT_THAT(refused({.max_channels = 2}), HasSubstr("3 channels: expected at most 2"));
  EXPECT_THAT(refused({.max_memory = 479}), HasSubstr("480 bytes of memory"));
  // 69 bytes that claim 60000x60000 pixels.
  EXPECT_THAT(refusal([&] { read_image(kData / "bomb.png"); }),
              HasSubstr("60000x60000 pixels: expected at most 268435456"));
}

TEST(ImageFile, KnowsExrByItsExtension) {
  EXPECT_TRUE(is_exr("a/b.exr"));
  EXPECT_TRUE(is_exr("a.EXR"));
  EXPECT_FALSE(is_exr("a.png"));
  EXPECT_FALSE(is_exr("exr"));
  EXPECT_FALSE(is_exr("a.exr/b"));
}

TEST(ImageFile, KnowsExrByItsFirstBytesToo) {
  const fs::path folder = scratch();
  write_bytes(folder / "a.png", "\x76\x2f\x31\x01 and so on");
  write_bytes(folder / "short", "\x76\x2f\x31");
  write_bytes(folder / "text.exr", "words");
  EXPECT_TRUE(holds_exr(folder / "a.png"));
  EXPECT_TRUE(holds_exr(folder / "text.exr"));
  EXPECT_TRUE(holds_exr(folder / "absent.exr"));
  EXPECT_FALSE(holds_exr(folder / "short"));
  EXPECT_FALSE(holds_exr(folder / "absent.png"));
  EXPECT_FALSE(holds_exr(folder));
}

// In a process of its own, because a module once loaded stays.
TEST(ImageFileDeathTest, PngAndJpegNeedNoModule) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const fs::path folder = scratch();
  const auto try_without = [&] {
    setenv("LIMPID_MODULE_DIR", folder.c_str(), 1);
    for (const char* name : {"a.png", "a.jpg"}) {
      expect_image8(folder / name);
      write_image8(folder / name, views(noise({0, 0, 9, 7}, 3)));
      fs::rename(folder / name, folder / "b.tif");  // known by its first bytes
      if (read_image(folder / "b.tif").window != Rect{0, 0, 9, 7}) std::exit(4);
    }
    std::exit(3);
  };
  EXPECT_EXIT(try_without(), testing::ExitedWithCode(3), "");
}

TEST(ImageFileDeathTest, SaysWhichModuleIsMissing) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const fs::path folder = scratch();
  const auto try_without = [&] {
    setenv("LIMPID_MODULE_DIR", folder.c_str(), 1);
    const std::string sentence = refusal([] { read_image(kData / "tiled.tif"); });
    std::fprintf(stderr, "%s", sentence.c_str());
    std::exit(3);
  };
  EXPECT_EXIT(
      try_without(), testing::ExitedWithCode(3),
      "tiled.tif: formats other than EXR, PNG and JPEG need limpid_formats.so, which is not in .*");
  write_bytes(folder / "limpid_formats.so", "not a library");
  EXPECT_EXIT(try_without(), testing::ExitedWithCode(3), "cannot load the format module");
}

// Its libraries would crash as they are loaded.
TEST(ImageFileDeathTest, SaysThatTheModuleHasNoMemory) {
  if (test::kSanitized) GTEST_SKIP() << "a sanitizer has addresses of its own";
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto try_without = [] {
    test::limit_addresses(std::size_t{256} << 20);
    const std::string sentence = refusal([] { read_image(kData / "tiled.tif"); });
    std::fprintf(stderr, "%s", sentence.c_str());
    std::exit(3);
  };
  EXPECT_EXIT(try_without(), testing::ExitedWithCode(3), "tiled.tif: needs more memory than");
}

// A file that may not grow stands for a full disk; in a process of its own, for the limit stays.
TEST(ImageFileDeathTest, LeavesNothingOnAFullDisk) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const fs::path folder = scratch();
  const auto write_over_the_limit = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    int refused = 0;
    for (const char* name : {"a.png", "a.jpg", "a.tif"}) {
      const std::string sentence = refusal([&] {
        write_image8(folder / name, views(noise({0, 0, 90, 90}, 3)));
      });
      refused += sentence.find("cannot be written") != std::string::npos;
    }
    std::exit(refused);
  };
  EXPECT_EXIT(write_over_the_limit(), testing::ExitedWithCode(3), "");
  EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace limpid

#include "limpid/files/exr/exr_writer.h"

#include <array>
#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <sys/resource.h>

#include "limpid/core/error.h"

#include "files/content_hash.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr float kInf = std::numeric_limits<float>::infinity();
const Rect kData{-7, 5, 90, 305};
const Rect kDisplay{0, 0, 80, 320};

/// An empty folder of its own for each test.
fs::path folder() {
  const fs::path path =
      fs::path(testing::TempDir()) /
      (std::string("exr_writer_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

int files_in(const fs::path& path) {
  return static_cast<int>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
}

std::vector<char> bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Smooth, so that lossy compressions stay near it; exact as half.
float value_at(int x, int y) {
  return static_cast<float>(x + 7) / 128 + static_cast<float>(y) / 512;
}

Plane picture() {
  Plane plane(kData);
  for (int y = kData.y0; y < kData.y1; ++y) {
    for (int x = kData.x0; x < kData.x1; ++x) plane.view().at(x, y) = value_at(x, y);
  }
  return plane;
}

ExrOutput output_of(const Plane& plane) {
  ExrOutput output;
  output.data = kData;
  output.display = kDisplay;
  output.channels = {{"R", plane.view(), true}, {"depth.Z", plane.view(), false}};
  return output;
}

Plane read(const fs::path& path, const std::string& channel, const Rect& window) {
  Plane plane(window);
  ExrFile::open(path).read(std::array{ExrRequest{0, channel, plane.view()}});
  return plane;
}

std::string error_of(const fs::path& path, const ExrOutput& output) {
  try {
    write_exr(path, output);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class ExrWriterCompression : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(ExrWriterCompression, ComesBack) {
  const auto [name, tolerance] = GetParam();
  const fs::path path = folder() / "a.exr";
  const Plane plane = picture();
  ExrOutput output = output_of(plane);
  output.compression = name;
  output.pixel_aspect = 2;
  write_exr(path, output);
  const ExrPart part = ExrFile::open(path).parts()[0];
  EXPECT_EQ(part.compression, output.compression.substr(0, output.compression.find(':')));
  EXPECT_EQ(part.data, kData);
  EXPECT_EQ(part.display, kDisplay);
  EXPECT_EQ(part.pixel_aspect, 2);
  EXPECT_EQ(part.channels[0].type, SampleType::kHalf);
  EXPECT_EQ(part.channels[1].type, SampleType::kFloat);
  const Plane r = read(path, "R", kData), z = read(path, "depth.Z", kData);
  double worst_r = 0, worst_z = 0;
  for (int y = kData.y0; y < kData.y1; ++y) {
    for (int x = kData.x0; x < kData.x1; ++x) {
      const double value = value_at(x, y);
      worst_r = std::max(worst_r, std::abs(r.view().at(x, y) - value));
      worst_z = std::max(worst_z, std::abs(z.view().at(x, y) - value));
    }
  }
  EXPECT_LE(worst_r, tolerance);
  EXPECT_LE(worst_z, output.compression == "pxr24" ? 1e-4 : 0);
  EXPECT_EQ(files_in(path.parent_path()), 1);
}

INSTANTIATE_TEST_SUITE_P(All, ExrWriterCompression,
                         testing::Values(std::pair{"none", 0.0}, std::pair{"rle", 0.0},
                                         std::pair{"zips", 0.0}, std::pair{"zip", 0.0},
                                         std::pair{"zip:9", 0.0}, std::pair{"piz", 0.0},
                                         std::pair{"pxr24", 0.0}, std::pair{"b44", 0.02},
                                         std::pair{"b44a", 0.02}, std::pair{"dwaa", 0.02},
                                         std::pair{"dwab:10", 0.02}),
                         [](const auto& test) {
                           std::string name = test.param.first;
                           for (char& c : name) {
                             if (c == ':') c = '_';
                           }
                           return name;
                         });

TEST(ExrWriter, LevelsChangeTheSize) {
  const fs::path here = folder();
  Plane plane = picture();
  for (int y = kData.y0; y < kData.y1; ++y) {
    for (int x = kData.x0; x < kData.x1; ++x) {
      plane.view().at(x, y) = 1 + 0.2f * std::sin(static_cast<float>(x * 37 + y * y));
    }
  }
  const auto size = [&](const char* compression) {
    ExrOutput output = output_of(plane);
    output.channels = {{"R", plane.view()}, {"G", plane.view()}, {"B", plane.view()}};
    output.compression = compression;
    write_exr(here / "a.exr", output);
    return fs::file_size(here / "a.exr");
  };
  EXPECT_LT(size("zip:9"), size("zip:1"));
  EXPECT_LT(size("dwaa:300"), size("dwaa:10"));
  EXPECT_EQ(size("dwaa:45"), size("dwaa"));
}

TEST(ExrWriter, ReadsEveryStrideAndLargerWindows) {
  const fs::path here = folder();
  const Rect around{-10, 0, 100, 310};
  const int width = around.width(), height = around.height();
  for (std::ptrdiff_t x_stride : {1, 3, -1}) {
    for (bool upside_down : {false, true}) {
      const std::ptrdiff_t row = std::abs(x_stride) * width;
      std::vector<float> memory(static_cast<std::size_t>(row * height), -1.0f);
      View<float> view{memory.data(), x_stride, upside_down ? -row : row, around};
      if (x_stride < 0) view.data += width - 1;
      if (upside_down) view.data += row * (height - 1);
      for (int y = kData.y0; y < kData.y1; ++y) {
        for (int x = kData.x0; x < kData.x1; ++x) view.at(x, y) = value_at(x, y);
      }
      ExrOutput output;
      output.data = kData;
      output.display = kDisplay;
      output.channels = {{"H", view, true}, {"F", view, false}};
      write_exr(here / "a.exr", output);
      for (const char* channel : {"H", "F"}) {
        const Plane back = read(here / "a.exr", channel, kData);
        for (int y = kData.y0; y < kData.y1; ++y) {
          for (int x = kData.x0; x < kData.x1; ++x) {
            ASSERT_EQ(back.view().at(x, y), value_at(x, y)) << channel << x << " " << y;
          }
        }
      }
    }
  }
}

TEST(ExrWriter, ClampsFiniteOverflowOfHalfAlone) {
  const fs::path path = folder() / "a.exr";
  const float in[] = {1e10f, -1e10f, 65519.9f, 65504, kInf, -kInf, std::nanf(""), 1e-9f};
  const Rect window{0, 0, 8, 1};
  ExrOutput output;
  output.data = output.display = window;
  output.channels = {{"H", {in, 1, 8, window}, true}, {"F", {in, 1, 8, window}, false}};
  write_exr(path, output);
  const Plane h = read(path, "H", window), f = read(path, "F", window);
  const float expected[] = {65504, -65504, 65504, 65504, kInf, -kInf, 0, 0};
  for (int x = 0; x < 8; ++x) {
    if (x == 6) {
      EXPECT_TRUE(std::isnan(h.view().at(x, 0)));
      EXPECT_TRUE(std::isnan(f.view().at(x, 0)));
    } else {
      EXPECT_EQ(h.view().at(x, 0), expected[x]);
      EXPECT_EQ(f.view().at(x, 0), in[x]);
    }
  }
}

TEST(ExrWriter, PassesAttributesOnByteForByte) {
  const fs::path path = folder() / "a.exr";
  const Plane plane = picture();
  ExrOutput output = output_of(plane);
  const std::vector<char> center{0, 0, 0, 63, 0, 0, 0, 64};  // 0.5, 2
  const std::string long_name = "cycles.ViewLayer.synchronization_time";
  output.inherited = {{"studio/secret", {"no_such_type", {1, 0, -1, 7}}},
                      {"empty", {"string", {}}},
                      {"comments", {"string", {'o', 'l', 'd'}}},
                      {"worldToCamera", {"m44f", std::vector<char>(64, 1)}},
                      {long_name, {"string", {'x'}}},
                      {"screenWindowCenter", {"v2f", center}},
                      {"channels", {"chlist", {0}}},
                      {"compression", {"compression", {0}}},
                      {"dataWindow", {"box2i", std::vector<char>(16, 0)}},
                      {"type", {"string", {'d', 'e', 'e', 'p'}}},
                      {"preview", {"preview", std::vector<char>(8, 0)}}};
  output.text = {{"comments", "ours"}, {"limpid/version", "1"}};
  std::array<float, 16> matrix;
  for (std::size_t i = 0; i < 16; ++i) matrix[i] = static_cast<float>(i);
  output.matrices = {{"worldToCamera", matrix}};
  write_exr(path, output);

  const ExrFile file = ExrFile::open(path);
  const auto attributes = file.attributes(0);
  for (const char* name : {"studio/secret", "empty", "screenWindowCenter", long_name.c_str()}) {
    ASSERT_TRUE(attributes.contains(name)) << name;
    EXPECT_EQ(attributes.at(name).type, output.inherited.at(name).type);
    EXPECT_EQ(attributes.at(name).bytes, output.inherited.at(name).bytes);
  }
  EXPECT_EQ(file.text_attribute(0, "comments"), "ours");
  EXPECT_EQ(file.text_attribute(0, "limpid/version"), "1");
  EXPECT_EQ(file.matrix_attribute(0, "worldToCamera"), matrix);
  EXPECT_EQ(file.parts()[0].data, kData);
  EXPECT_EQ(file.parts()[0].channels.size(), 2u);
  EXPECT_EQ(file.parts()[0].compression, "piz");

  // A second generation has exactly the same attributes.
  ExrOutput second = output_of(plane);
  second.inherited = attributes;
  write_exr(path, second);
  const auto again = ExrFile::open(path).attributes(0);
  ASSERT_EQ(again.size(), attributes.size());
  for (const auto& [name, attribute] : attributes) EXPECT_EQ(again.at(name).bytes, attribute.bytes);
}

TEST(ExrWriter, BytesDependOnTheArgumentsAlone) {
  const fs::path here = folder();
  const Plane plane = picture();
  for (const char* compression : {"zip", "piz", "dwab"}) {
    ExrOutput output = output_of(plane);
    output.compression = compression;
    set_file_threads(0);
    write_exr(here / "one.exr", output);
    for (int threads : {2, 5}) {
      set_file_threads(threads);
      write_exr(here / "many.exr", output);
      EXPECT_EQ(bytes_of(here / "one.exr"), bytes_of(here / "many.exr")) << compression;
    }
  }
  set_file_threads(0);
}

TEST(ExrWriter, AWholeFileIsToldFromAPartOfIt) {
  const fs::path path = folder() / "a.exr", cut = path.parent_path() / "cut.exr";
  const Plane plane = picture();
  for (const std::string compression : {"none", "piz", "zips", "dwab"}) {
    ExrOutput output = output_of(plane);
    output.compression = compression;
    write_exr(path, output);
    EXPECT_TRUE(ExrFile::open(path).is_whole()) << compression;
    const std::vector<char> bytes = bytes_of(path);
    int opened = 0;
    for (std::size_t size = bytes.size() - 1; size > bytes.size() / 2; size -= bytes.size() / 16) {
      std::ofstream(cut, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(size));
      try {
        EXPECT_FALSE(ExrFile::open(cut).is_whole()) << compression << " " << size;
        ++opened;
      } catch (const Error&) {
      }
    }
    EXPECT_GT(opened, 0) << compression;
  }
}

/// Any byte of the file, each in turn.
TEST(ExrWriter, AFileTellsWhetherItIsAsItWasWritten) {
  const fs::path path = folder() / "a.exr", other = path.parent_path() / "other.exr";
  Plane small({0, 0, 7, 5});
  ExrOutput output;
  output.data = output.display = small.view().window;
  output.channels = {{"R", small.view(), true}};
  output.text = {{"comments", "ours"}};
  write_exr(path, output);
  EXPECT_EQ(ExrFile::open(path).is_as_written(), true);

  const std::vector<char> bytes = bytes_of(path);
  int opened = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<char> changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 4);
    std::ofstream(other, std::ios::binary)
        .write(changed.data(), static_cast<std::streamsize>(changed.size()));
    try {
      EXPECT_NE(ExrFile::open(other).is_as_written(), true) << "byte " << i;
      ++opened;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(opened, 100);
  std::ofstream(path, std::ios::binary | std::ios::app) << '.';
  EXPECT_EQ(ExrFile::open(path).is_as_written(), false);
}

/// As a program in another language would check it.
TEST(ExrWriter, TheHashIsOfAllBytesButItself) {
  const fs::path path = folder() / "a.exr";
  const Plane plane = picture();
  write_exr(path, output_of(plane));
  const std::vector<char> read = bytes_of(path);
  std::string bytes(read.begin(), read.end());
  const std::size_t at = bytes.find("limpid_file_hash") + 28;  // the name, "string", the size
  const std::string said = bytes.substr(at, 32);
  EXPECT_EQ(ExrFile::open(path).text_attribute(0, "limpid_file_hash"), said);
  EXPECT_EQ(said, hash_of(bytes.replace(at, 32, 32, '0')));
  // It is not handed on.
  EXPECT_FALSE(ExrFile::open(path).attributes(0).contains("limpid_file_hash"));
}

TEST(ExrWriter, RefusesWhatItCannotWrite) {
  const fs::path here = folder(), path = here / "a.exr";
  const Plane plane = picture();
  const auto error = [&](auto change) {
    ExrOutput output = output_of(plane);
    change(output);
    const std::string text = error_of(path, output);
    EXPECT_THAT(text, StartsWith(path.string() + ": "));
    return text;
  };
  EXPECT_EQ(error([](ExrOutput& o) { o.compression = "zipp"; }),
            path.string() +
                ": compression 'zipp': expected one of none, rle, zips, zip, piz, pxr24, "
                "b44, b44a, dwaa, dwab; did you mean 'zips'?");
  for (const char* level :
       {"zip:0", "zip:10", "zip:2.5", "zip:", "zip:4x", "dwaa:-1", "dwaa:nan"}) {
    EXPECT_THAT(error([&](ExrOutput& o) { o.compression = level; }),
                HasSubstr("expected a level of"));
  }
  EXPECT_THAT(error([](ExrOutput& o) { o.compression = "piz:3"; }), HasSubstr("has no level"));
  EXPECT_THAT(error([](ExrOutput& o) { o.data.x1 += 1; }),
              HasSubstr("channel 'R' does not cover the data window"));
  EXPECT_THAT(error([](ExrOutput& o) { o.data = {}; }), HasSubstr("data window is empty"));
  EXPECT_THAT(error([](ExrOutput& o) { o.display = {}; }), HasSubstr("display window is empty"));
  EXPECT_THAT(error([](ExrOutput& o) { o.channels.clear(); }), HasSubstr("no channels"));
  EXPECT_THAT(error([](ExrOutput& o) { o.channels[1].name = "R"; }), HasSubstr("given twice"));
  EXPECT_THAT(error([](ExrOutput& o) { o.channels[1].name = ""; }), HasSubstr("channel name ''"));
  EXPECT_THAT(error([](ExrOutput& o) { o.pixel_aspect = 0; }), HasSubstr("pixel aspect ratio"));
  EXPECT_THAT(error([](ExrOutput& o) { o.text["type"] = "x"; }),
              HasSubstr("attribute name 'type'"));
  EXPECT_THAT(error([](ExrOutput& o) {
                o.inherited["screenWindowWidth"] = {"string", {}};
              }),
              HasSubstr("attribute 'screenWindowWidth' of type 'string': expected 'float'"));
  EXPECT_EQ(files_in(here), 0);
}

/// A limit on the size of files stands in for the full disk: the same way of failing.
TEST(ExrWriter, AFailedWriteLeavesTheOldFileAndNoOther) {
  const fs::path path = folder() / "a.exr";
  const Plane plane = picture();
  write_exr(path, output_of(plane));
  const std::vector<char> old = bytes_of(path);
  ExrOutput output = output_of(plane);
  output.compression = "none";
  const std::size_t whole = 97 * 300 * 6;

  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  std::vector<std::string> errors;
  for (std::size_t limit : {std::size_t{0}, std::size_t{100}, whole / 2, whole}) {
    const rlimit small{limit, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    errors.push_back(error_of(path, output));
    setrlimit(RLIMIT_FSIZE, &before);
  }
  std::signal(SIGXFSZ, handler);
  for (const std::string& error : errors) {
    EXPECT_EQ(error, path.string() + ": cannot be written (file too large)");
  }
  EXPECT_EQ(bytes_of(path), old);
  EXPECT_EQ(files_in(path.parent_path()), 1);
}

}  // namespace
}  // namespace limpid

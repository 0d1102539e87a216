#include "limpid/files/exr/exr_file.h"

#include <bit>
#include <random>

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOpaqueAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gmock/gmock.h>

#include "files/exr/exr_files.h"

namespace limpid {
namespace {

using exr_test::error_of;
using exr_test::expected;
using exr_test::kData;
using exr_test::Storage;
using exr_test::temporary;
using exr_test::write_file;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr float kUntouched = -77.125f, kMissing = -1;

/// A view with strange strides, in memory that is checked around the view.
struct Target {
  Target(const Rect& window, std::ptrdiff_t x_stride, bool upside_down) {
    const std::ptrdiff_t row = std::abs(x_stride) * window.width() + 3;
    memory.assign(static_cast<std::size_t>(row * window.height() + 8), kUntouched);
    view.data = memory.data() + 4;
    view.x_stride = x_stride;
    view.y_stride = upside_down ? -row : row;
    if (x_stride < 0) view.data += -x_stride * (window.width() - 1);
    if (upside_down) view.data += row * (window.height() - 1);
    view.window = window;
  }
  std::vector<float> memory;
  View<float> view;
};

void expect_picture(const Target& target, const std::string& channel) {
  const View<float>& view = target.view;
  std::size_t touched = 0;
  for (int y = view.window.y0; y < view.window.y1; ++y) {
    for (int x = view.window.x0; x < view.window.x1; ++x) {
      const bool inside = kData.contains({x, y, x + 1, y + 1});
      ASSERT_EQ(view.at(x, y), inside ? expected(channel, x, y) : kMissing)
          << channel << " at " << x << ", " << y;
      ++touched;
    }
  }
  const auto untouched = std::count(target.memory.begin(), target.memory.end(), kUntouched);
  EXPECT_EQ(touched + static_cast<std::size_t>(untouched), target.memory.size());
}

const Rect kWindows[] = {
    kData,
    {-10, 0, 70, 150},    // larger on all sides
    {10, 40, 30, 80},     // within
    {-20, 100, 20, 200},  // shifted
    {-5, 50, 60, 51},     // one row
    {200, 0, 210, 10},    // elsewhere
    {0, -30, 10, 2},      // above
};

class ExrFileStorage : public testing::TestWithParam<Storage> {};

TEST_P(ExrFileStorage, ReadsEveryTypeIntoEveryWindowAndStride) {
  const std::string path = temporary("a.exr");
  write_file(path, GetParam());
  const int part = GetParam().part;
  for (int threads : {0, 3}) {
    set_file_threads(threads);
    const ExrFile file = ExrFile::open(path);
    for (const Rect& window : kWindows) {
      Target h(window, 1, false), f(window, 4, true), u(window, -2, false);
      const ExrRequest requests[] = {{part, "H", h.view, kMissing},
                                     {part, "F", f.view, kMissing},
                                     {part, "U", u.view, kMissing}};
      file.read(requests);
      expect_picture(h, "H");
      expect_picture(f, "F");
      expect_picture(u, "U");
      Target alone(window, 2, true);
      file.read(std::array{ExrRequest{part, "U", alone.view, kMissing}});
      expect_picture(alone, "U");
    }
  }
  set_file_threads(0);
}

TEST_P(ExrFileStorage, ReadsChannelsIntoDifferentWindowsAndTwice) {
  const std::string path = temporary("a.exr");
  write_file(path, GetParam());
  const int part = GetParam().part;
  const ExrFile file = ExrFile::open(path);
  Target first(kWindows[1], 1, false), second(kWindows[2], 1, true), other(kWindows[3], -1, true);
  const ExrRequest requests[] = {{part, "F", first.view, kMissing},
                                 {part, "F", second.view, kMissing},
                                 {part, "H", other.view, kMissing}};
  file.read(requests);
  expect_picture(first, "F");
  expect_picture(second, "F");
  expect_picture(other, "H");
}

TEST_P(ExrFileStorage, TellsWhatTheHeaderSays) {
  const std::string path = temporary("a.exr");
  write_file(path, GetParam());
  const ExrFile file = ExrFile::open(path);
  const ExrPart& part = file.parts()[GetParam().part];
  EXPECT_EQ(file.path(), path);
  EXPECT_EQ(part.data, kData);
  EXPECT_EQ(part.display, exr_test::kDisplay);
  EXPECT_EQ(part.pixel_aspect, 1.5);
  EXPECT_EQ(part.tiled, GetParam().tile_width > 0);
  EXPECT_FALSE(part.deep);
  EXPECT_EQ(part.name, GetParam().part > 0 ? "beauty" : "");
  EXPECT_EQ(part.view, GetParam().part > 0 ? "left" : "");
  ASSERT_EQ(part.channels.size(), 3u);
  EXPECT_EQ(part.channels[0].name, "F");
  EXPECT_EQ(part.channels[0].type, SampleType::kFloat);
  EXPECT_EQ(part.channels[1].type, SampleType::kHalf);
  EXPECT_EQ(part.channels[2].type, SampleType::kUint);
}

/// What hardly shrinks is stored as it is.
class ExrFileNoise : public testing::TestWithParam<Imf::Compression> {};

TEST_P(ExrFileNoise, KeepsEveryBit) {
  constexpr int kWidth = 67, kHeight = 75, kCount = kWidth * kHeight;
  std::mt19937 random(11);
  for (const std::uint32_t mask : {0xffffffffu, 0x00030003u, 0x7f80ffffu}) {
    std::vector<std::uint16_t> h(kCount);
    std::vector<std::uint32_t> f(kCount);
    for (std::uint16_t& bits : h) bits = static_cast<std::uint16_t>(random() & mask & 0xfbff);
    for (std::uint32_t& bits : f) bits = static_cast<std::uint32_t>(random()) & mask & 0xff7fffff;
    const std::string path = temporary("noise.exr");
    Imf::Header header(kWidth, kHeight);
    header.compression() = GetParam();
    header.channels().insert("F", Imf::Channel(Imf::FLOAT));
    header.channels().insert("H", Imf::Channel(Imf::HALF));
    Imf::FrameBuffer pixels;
    pixels.insert("F", {Imf::FLOAT, reinterpret_cast<char*>(f.data()), 4, 4 * kWidth});
    pixels.insert("H", {Imf::HALF, reinterpret_cast<char*>(h.data()), 2, 2 * kWidth});
    {
      Imf::OutputFile file(path.c_str(), header);
      file.setFrameBuffer(pixels);
      file.writePixels(kHeight);
    }
    for (const int threads : {0, 3}) {
      set_file_threads(threads);
      const ExrFile file = ExrFile::open(path);
      const Rect window{0, 0, kWidth, kHeight};
      Target floats(window, 1, false), halves(window, 1, false);
      const ExrRequest requests[] = {{0, "F", floats.view}, {0, "H", halves.view}};
      file.read(requests);
      for (int i = 0; i < kCount; ++i) {
        const int x = i % kWidth, y = i / kWidth;
        half expected_half;
        expected_half.setBits(h[static_cast<std::size_t>(i)]);
        ASSERT_EQ(std::bit_cast<std::uint32_t>(floats.view.at(x, y)), f[std::size_t(i)]) << i;
        ASSERT_EQ(halves.view.at(x, y), float(expected_half)) << i;
      }
    }
    set_file_threads(0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExrFileNoise,
                         testing::Values(Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION,
                                         Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
                                         Imf::PIZ_COMPRESSION));

INSTANTIATE_TEST_SUITE_P(
    All, ExrFileStorage,
    testing::Values(Storage{"none", Imf::NO_COMPRESSION}, Storage{"rle", Imf::RLE_COMPRESSION},
                    Storage{"zips", Imf::ZIPS_COMPRESSION}, Storage{"zip"},
                    Storage{"piz", Imf::PIZ_COMPRESSION}, Storage{"dwab", Imf::DWAB_COMPRESSION},
                    Storage{"decreasing", Imf::PIZ_COMPRESSION, true},
                    Storage{"tiles", Imf::ZIP_COMPRESSION, false, 16, 8},
                    Storage{"big_tiles", Imf::PIZ_COMPRESSION, false, 128, 100},
                    Storage{"mip_tiles", Imf::ZIP_COMPRESSION, false, 32, 32, true},
                    Storage{"second_part", Imf::ZIP_COMPRESSION, false, 0, 0, false, 1}),
    [](const auto& storage) { return storage.param.name; });

TEST(ExrFile, RefusesWhatItCannotRead) {
  const std::string path = temporary("a.exr");
  write_file(path, {"two", Imf::ZIP_COMPRESSION, false, 0, 0, false, 1});
  const ExrFile file = ExrFile::open(path);
  Plane plane(Rect{0, 0, 4, 4});
  const auto error = [&](std::vector<ExrRequest> requests) {
    return error_of([&] { file.read(requests); });
  };
  EXPECT_EQ(error({{1, "h", plane.view()}}),
            path + ": no channel 'h' in part 1 ('beauty'): expected one of F, H, U");
  EXPECT_EQ(error({{2, "H", plane.view()}}), path + ": part 2: expected 0 ... 1");
  EXPECT_EQ(error({{-1, "H", plane.view()}}), path + ": part -1: expected 0 ... 1");
  EXPECT_THAT(error({{1, "H", View<float>{}}}), HasSubstr("channel 'H' has no memory"));
  EXPECT_THAT(error_of([&] { file.attributes(5); }), AllOf(StartsWith(path), HasSubstr("part 5")));
  EXPECT_NO_THROW(file.read({}));
}

TEST(ExrFile, ListsDeepPartsAndDoesNotReadThemAsFlat) {
  const std::string path = temporary("deep.exr");
  exr_test::write_deep(path);
  const ExrFile file = ExrFile::open(path);
  ASSERT_EQ(file.parts().size(), 1u);
  EXPECT_TRUE(file.parts()[0].deep);
  EXPECT_EQ(file.parts()[0].channels[0].name, "Z");
  Plane z(file.parts()[0].data);
  EXPECT_EQ(error_of([&] {
              file.read(std::array{ExrRequest{0, "Z", z.view()}});
            }),
            path + ": part 0 holds deep samples: expected flat pixels");
  EXPECT_EQ(exr_test::failure_of(path), "");
}

TEST(ExrFile, RefusesWhatIsOverALimit) {
  const std::string path = temporary("a.exr");
  write_file(path, {"two", Imf::ZIP_COMPRESSION, false, 0, 0, false, 1});
  const auto error = [&](const Limits& limits) {
    return error_of([&] { ExrFile::open(path, limits); });
  };
  EXPECT_EQ(error({.max_pixels = 9359}),
            path + ": data window of 65x144 pixels: expected at most 9359");
  EXPECT_EQ(error({.max_pixels = 9360}), "no error was thrown");
  EXPECT_EQ(error({.max_side = 143}),
            path + ": data window of 65x144 pixels: expected sides of at most 143");
  EXPECT_EQ(error({.max_channels = 2}), path + ": more than 2 channels in one part, the limit");
  EXPECT_EQ(error({.max_parts = 1}), path + ": more than 1 parts, the limit");
  EXPECT_THAT(error({.max_memory = 1000}), HasSubstr("memory"));

  Plane plane(kData);
  const ExrFile file = ExrFile::open(path, {.max_memory = 65 * 144 * 4 * 2});
  const ExrRequest request{1, "H", plane.view()};
  EXPECT_NO_THROW(file.read(std::array{request, request}));
  EXPECT_THAT(error_of([&] {
                file.read(std::array{request, request, request});
              }),
              AllOf(StartsWith(path), HasSubstr("more memory than the limit")));
}

TEST(ExrFile, ALimitWithoutMemoryForManyThreadsIsReadByFewer) {
  const std::string path = temporary("a.exr");
  for (const Imf::Compression how : {Imf::PIZ_COMPRESSION, Imf::DWAB_COMPRESSION}) {
    write_file(path, {"lines", how});
    for (const int threads : {0, 100}) {
      set_file_threads(threads);
      const ExrFile file = ExrFile::open(path, {.max_memory = 65 * 256 * 10 * 2});
      Plane plane(kData);
      file.read(std::array{ExrRequest{0, "F", plane.view()}});
      EXPECT_NEAR(plane.view().at(59, 146), expected("F", 59, 146), 1e3);
      EXPECT_THROW(ExrFile::open(path, {.max_memory = 65 * 32 * 10 * 4}), Error);
    }
    set_file_threads(0);
  }
}

TEST(ExrFile, RefusesOtherFiles) {
  EXPECT_EQ(exr_test::failure_of("/no/such.exr"),
            "/no/such.exr: cannot be opened (no such file or directory)");
  EXPECT_EQ(exr_test::failure_of(testing::TempDir()), testing::TempDir() + ": is not a file");
  const std::string path = temporary("a.exr");
  exr_test::write_bytes(path, {});
  EXPECT_EQ(exr_test::failure_of(path), path + ": is not an OpenEXR file");
}

TEST(ExrFile, LuminanceChromaReadsAsColor) {
  const std::string path = temporary("yc.exr");
  exr_test::write_luminance_chroma(path, false);
  const ExrFile file = ExrFile::open(path);
  std::string names;
  for (const ExrChannel& channel : file.parts()[0].channels) {
    names += channel.name;
    EXPECT_EQ(channel.x_sampling, 1);
  }
  EXPECT_EQ(names, "ABGR");
  const Rect window{-6, 0, 98, 84};
  Target r(window, 1, false), g(window, 3, true), b({10, 20, 12, 22}, 1, false), a(window, 1, true);
  const ExrRequest requests[] = {{0, "R", r.view, kMissing},
                                 {0, "G", g.view, kMissing},
                                 {0, "B", b.view, kMissing},
                                 {0, "A", a.view, kMissing}};
  file.read(requests);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const bool inside = file.parts()[0].data.contains({x, y, x + 1, y + 1});
      EXPECT_NEAR(r.view.at(x, y), inside ? 0.5f : kMissing, 4e-3f);
      EXPECT_NEAR(g.view.at(x, y), inside ? 0.25f : kMissing, 4e-3f);
      EXPECT_EQ(a.view.at(x, y), inside ? 0.75f : kMissing);
    }
  }
  EXPECT_NEAR(b.view.at(11, 21), 0.125f, 4e-3f);
  Plane plane(window);
  EXPECT_THAT(error_of([&] {
                file.read(std::array{ExrRequest{0, "Y", plane.view()}});
              }),
              HasSubstr("expected one of A, B, G, R"));
}

TEST(ExrFile, LuminanceAloneStaysLuminance) {
  const std::string path = temporary("y.exr");
  exr_test::write_luminance_chroma(path, true);
  const ExrFile file = ExrFile::open(path);
  ASSERT_EQ(file.parts()[0].channels.size(), 2u);
  EXPECT_EQ(file.parts()[0].channels[1].name, "Y");
  EXPECT_EQ(exr_test::failure_of(path), "");
}

/// Writes constant channels of half type, 8x8 pixels, each with its own sampling.
void write_sampled(const std::string& path,
                   const std::vector<std::pair<std::string, int>>& channels,
                   const std::vector<float>& values) {
  Imf::Header header(8, 8);
  Imf::FrameBuffer frame;
  std::vector<std::vector<half>> pixels;
  for (float value : values) pixels.emplace_back(64, half(value));
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const auto& [name, sampling] = channels[i];
    header.channels().insert(name, Imf::Channel(Imf::HALF, sampling, sampling));
    frame.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(pixels[i].data()), 2, 16,
                                  sampling, sampling));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(8);
}

TEST(ExrFile, LuminanceChromaOfALayer) {
  const std::string path = temporary("yc.exr");
  write_sampled(path, {{"left.Y", 1}, {"left.RY", 2}, {"left.BY", 2}, {"Z", 1}}, {0.5, 0, 0, 9});
  const ExrFile file = ExrFile::open(path);
  Plane g(Rect{0, 0, 8, 8}), z(Rect{0, 0, 8, 8});
  file.read(std::array{ExrRequest{0, "left.G", g.view()}, ExrRequest{0, "Z", z.view()}});
  EXPECT_NEAR(g.view().at(3, 3), 0.5f, 1e-3f);  // no chroma: grey
  EXPECT_EQ(z.view().at(3, 3), 9);
  EXPECT_EQ(error_of([&] {
              file.read(std::array{ExrRequest{0, "lft.R", g.view()}});
            }),
            path +
                ": no channel 'lft.R' in part 0: expected one of Z, left.B, left.G, left.R; did "
                "you mean 'left.R'?");
}

TEST(ExrFile, OtherSubsampledChannelsAreRefused) {
  const std::string path = temporary("sub.exr");
  write_sampled(path, {{"Y", 1}, {"RY", 2}, {"Z", 1}}, {0.5, 0, 3});
  const ExrFile file = ExrFile::open(path);
  Plane plane(Rect{0, 0, 8, 8});
  EXPECT_NO_THROW(file.read(std::array{ExrRequest{0, "Z", plane.view()}}));
  EXPECT_EQ(plane.view().at(7, 7), 3);
  EXPECT_THAT(exr_test::failure_of(path),
              HasSubstr("channel 'RY' is stored for every 2x2 pixels, which is supported"));
}

TEST(ExrFile, HandsOutAttributes) {
  const std::string path = temporary("a.exr");
  Imath::M44f matrix;
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = static_cast<float>(i);
  Imf::Header header(1, 1);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.insert("worldToCamera", Imf::M44fAttribute(matrix));
  header.insert("exact", Imf::M44dAttribute(Imath::M44d(matrix)));
  header.insert("near", Imf::DoubleAttribute(0.1));
  header.insert("frame", Imf::IntAttribute(-12));
  header.insert("Scene", Imf::StringAttribute("dock"));
  const float z = 1;
  Imf::FrameBuffer frame;
  frame.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(&z)), 4, 4));
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(1);
  }
  const ExrFile file = ExrFile::open(path);
  for (const char* name : {"worldToCamera", "exact"}) {
    const auto read = file.matrix_attribute(0, name);
    ASSERT_TRUE(read);
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ((*read)[i], static_cast<float>(i));
  }
  EXPECT_EQ(file.number_attribute(0, "near"), 0.1);
  EXPECT_EQ(file.number_attribute(0, "frame"), -12);
  EXPECT_EQ(file.number_attribute(0, "screenWindowWidth"), 1);
  EXPECT_EQ(file.text_attribute(0, "Scene"), "dock");
  EXPECT_FALSE(file.text_attribute(0, "near"));
  EXPECT_FALSE(file.number_attribute(0, "Scene"));
  EXPECT_FALSE(file.matrix_attribute(0, "near"));
  EXPECT_FALSE(file.matrix_attribute(0, "nothing"));

  const auto attributes = file.attributes(0);
  EXPECT_EQ(attributes.at("Scene").type, "string");
  EXPECT_EQ(attributes.at("Scene").bytes, (std::vector<char>{'d', 'o', 'c', 'k'}));
  for (const char* structural : {"channels", "compression", "dataWindow", "displayWindow",
                                 "lineOrder", "pixelAspectRatio", "type", "chunkCount"}) {
    EXPECT_FALSE(attributes.contains(structural)) << structural;
  }
}

}  // namespace
}  // namespace limpid

#include <cstring>
#include <fstream>

#include <gmock/gmock.h>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_file.h"
#include "limpid/files/exr/exr_writer.h"

#include "files/exr/part_files.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;
using exr_test::part_of;
using exr_test::write_parts;
using exr_test::WrittenPart;
using ::testing::HasSubstr;

const Rect kDisplay{0, 0, 70, 80};

fs::path folder() {
  const fs::path path =
      fs::path(testing::TempDir()) /
      (std::string("exr_copy_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

std::uint32_t scrambled(int x, int y, std::uint32_t of) {
  return (static_cast<std::uint32_t>(x + 1000) * 2654435761U) ^
         (static_cast<std::uint32_t>(y + 1000) * 40503U * of);
}

/// Samples of every type whose bits mean anything, not-a-numbers among them.
WrittenPart any_bits(const std::string& name, const Rect& data) {
  WrittenPart part = part_of(name, data, {});
  for (int y = data.y0; y < data.y1; ++y) {
    for (int x = data.x0; x < data.x1; ++x) {
      float number;
      const std::uint32_t bits = scrambled(x, y, 3);
      std::memcpy(&number, &bits, sizeof bits);
      part.channels["hash.r"].push_back(number);
      part.halves["N.X"].push_back(static_cast<std::uint16_t>(scrambled(x, y, 5)));
      part.uints["id"].push_back(scrambled(x, y, 7));
    }
  }
  return part;
}

/// The bytes of a channel in a window that its part has whole rows of.
std::vector<char> stored(const ExrFile& file, int part, const std::string& channel) {
  const Rect data = file.parts()[static_cast<std::size_t>(part)].data;
  std::vector<char> bytes(static_cast<std::size_t>(data.area()) * 4, 'x');
  char* const into[] = {bytes.data()};
  file.read_stored(part, std::array{channel}, data.y0, data.y1, into);
  return bytes;
}

/// The bytes that a pixel of such rows has.
std::vector<char> pixel(const std::vector<char>& rows, const Rect& data, int x, int y,
                        std::size_t size) {
  const auto at = static_cast<std::ptrdiff_t>(size) *
                  (std::ptrdiff_t{y - data.y0} * data.width() + (x - data.x0));
  return {rows.begin() + at, rows.begin() + at + static_cast<std::ptrdiff_t>(size)};
}

ExrOutput output_of(const Plane& plane) {
  ExrOutput output;
  output.data = plane.view().window;
  output.display = kDisplay;
  output.channels = {{"R", plane.view(), true}};
  return output;
}

const char* const kNames[] = {"hash.r", "N.X", "id"};
constexpr std::size_t kSizes[] = {4, 2, 4};

/// Expects each channel's bits of the pixels that both have, and 0 where `from` has none.
void expect_bits(const ExrFile& file, int part, const ExrFile& from, int from_part) {
  const Rect to = file.parts()[static_cast<std::size_t>(part)].data;
  const Rect data = from.parts()[static_cast<std::size_t>(from_part)].data;
  for (int c = 0; c < 3; ++c) {
    const std::vector<char> made = stored(file, part, kNames[c]);
    const std::vector<char> was = stored(from, from_part, kNames[c]);
    const std::vector<char> nothing(kSizes[c], 0);
    for (int y = to.y0; y < to.y1; ++y) {
      for (int x = to.x0; x < to.x1; ++x) {
        const bool inside = data.contains({x, y, x + 1, y + 1});
        ASSERT_EQ(pixel(made, to, x, y, kSizes[c]),
                  inside ? pixel(was, data, x, y, kSizes[c]) : nothing)
            << kNames[c] << " at " << x << ", " << y;
      }
    }
  }
}

TEST(ExrCopy, KeepsTypesAndBitsInAnyWindow) {
  const fs::path here = folder();
  for (const Rect& data : {kDisplay, Rect{-9, -5, 90, 99}, Rect{11, 40, 33, 77}}) {
    for (const int tile : {0, 16}) {
      for (const auto compression : {Imf::PIZ_COMPRESSION, Imf::ZIPS_COMPRESSION}) {
        WrittenPart part = any_bits("", data);
        part.tile = tile;
        part.compression = compression;
        write_parts(here / "from.exr", kDisplay, {part});
        const ExrFile from = ExrFile::open(here / "from.exr");
        const Plane red(kDisplay);
        ExrOutput output = output_of(red);
        output.copies = {{&from, 0, {"hash.r", "N.X", "id"}}};
        write_exr(here / "to.exr", output);
        const ExrFile to = ExrFile::open(here / "to.exr");
        ASSERT_EQ(to.parts().size(), 1U);
        std::vector<std::pair<std::string, SampleType>> channels;
        for (const ExrChannel& c : to.parts()[0].channels) channels.emplace_back(c.name, c.type);
        EXPECT_THAT(channels, testing::ElementsAre(testing::Pair("N.X", SampleType::kHalf),
                                                   testing::Pair("R", SampleType::kHalf),
                                                   testing::Pair("hash.r", SampleType::kFloat),
                                                   testing::Pair("id", SampleType::kUint)));
        expect_bits(to, 0, from, 0);
      }
    }
  }
}

TEST(ExrCopy, PartsHaveNamesViewsAndWindowsOfTheirOwn) {
  const fs::path here = folder();
  const Rect small{3, 30, 20, 64};
  WrittenPart ids = any_bits("ids", small);
  ids.texts = {{"who/made", "a renderer"}};
  write_parts(here / "from.exr", kDisplay, {part_of("rgba", kDisplay, {"R"}), ids});
  const ExrFile from = ExrFile::open(here / "from.exr");
  const Plane red(kDisplay);
  std::vector<ExrOutput> parts = {output_of(red), {}};
  parts[0].name = "rgba.left";
  parts[0].view = "left";
  parts[1].name = "ids";
  parts[1].data = small;
  parts[1].display = kDisplay;
  parts[1].inherited = from.attributes(1);
  parts[1].copies = {{&from, 1, {"hash.r", "N.X", "id"}}};
  write_exr(here / "to.exr", parts);

  const ExrFile to = ExrFile::open(here / "to.exr");
  ASSERT_EQ(to.parts().size(), 2U);
  EXPECT_EQ(to.parts()[0].name, "rgba.left");
  EXPECT_EQ(to.parts()[0].view, "left");
  EXPECT_EQ(to.parts()[1].name, "ids");
  EXPECT_EQ(to.parts()[1].data, small);
  EXPECT_EQ(to.text_attribute(1, "who/made"), "a renderer");
  expect_bits(to, 1, from, 1);

  EXPECT_TRUE(to.is_whole());
  EXPECT_EQ(to.is_as_written(), true);
  const auto size = fs::file_size(here / "to.exr");
  for (const std::uintmax_t cut : {size - 1, size - 300}) {
    fs::copy_file(here / "to.exr", here / "cut.exr", fs::copy_options::overwrite_existing);
    fs::resize_file(here / "cut.exr", cut);
    EXPECT_FALSE(ExrFile::open(here / "cut.exr").is_whole()) << cut;
  }
  std::fstream changed(here / "to.exr", std::ios::in | std::ios::out | std::ios::binary);
  changed.seekp(static_cast<std::streamoff>(size - 5));
  changed.put('!');
  changed.close();
  EXPECT_EQ(ExrFile::open(here / "to.exr").is_as_written(), false);
}

std::string error_of(const fs::path& path, const std::vector<ExrOutput>& parts) {
  try {
    write_exr(path, parts);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ExrCopy, RefusesNamesThatAreThereAndMemoryThatIsNot) {
  const fs::path here = folder();
  write_parts(here / "from.exr", kDisplay, {any_bits("", kDisplay)});
  const ExrFile from = ExrFile::open(here / "from.exr");
  const Plane red(kDisplay);
  ExrOutput output = output_of(red);
  output.channels[0].name = "id";
  output.copies = {{&from, 0, {"id"}}};
  EXPECT_THAT(error_of(here / "to.exr", {output}), HasSubstr("channel 'id' is given twice"));
  output = output_of(red);
  EXPECT_THAT(error_of(here / "to.exr", {output, output}),
              HasSubstr("expected a different name for each part"));
  Limits limits;
  limits.max_memory = 60000;
  const ExrFile poor = ExrFile::open(here / "from.exr", limits);
  output.copies = {{&poor, 0, {"id", "hash.r"}}};
  EXPECT_THAT(error_of(here / "to.exr", {output}), HasSubstr("limit of 60000 bytes"));
  EXPECT_FALSE(fs::exists(here / "to.exr"));
}

}  // namespace
}  // namespace limpid

#include <array>
#include <bit>

#include <OpenEXR/ImfOpaqueAttribute.h>
#include <gmock/gmock.h>

#include "limpid/files/exr/exr_file.h"

#include "files/exr/exr_files.h"
#include "files/exr/part_files.h"
#include "files/exr/written.h"

/// Files whose channels lie in several parts.

namespace limpid {
namespace {

using exr_test::error_of;
using exr_test::level_at;
using exr_test::part_of;
using exr_test::write_parts;
using exr_test::WrittenPart;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr Rect kDisplay{0, 0, 40, 30}, kWindow{-4, -3, 44, 35};

/// Scan lines and tiles, compressions that are ours and OpenEXR's, windows of all sorts.
std::vector<WrittenPart> mixed_parts() {
  std::vector<WrittenPart> parts = {part_of("rgba", {0, 0, 40, 30}, {"R", "G", "B", "A"}),
                                    part_of("depth", {-4, -3, 44, 35}, {"Z"}, 10),
                                    part_of("shadow", {8, 6, 21, 19}, {"Y"}, 20),
                                    part_of("id", {3, 1, 40, 2}, {"R"}, 30)};
  parts[1].tile = 16;
  parts[1].compression = Imf::PIZ_COMPRESSION;
  parts[2].compression = Imf::NO_COMPRESSION;
  parts[3].compression = Imf::RLE_COMPRESSION;
  return parts;
}

TEST(MultiPart, OneRequestTakesChannelsOfAnyParts) {
  const std::vector<WrittenPart> parts = mixed_parts();
  const std::filesystem::path path = test::own_folder() / "parts.exr";
  write_parts(path, kDisplay, parts);
  struct Wanted {
    int part;
    std::string channel;
    float level;
    Plane plane = Plane(kWindow);
  };
  for (const int threads : {0, 3}) {
    set_file_threads(threads);
    Wanted wanted[] = {{1, "Z", 10}, {0, "B", 3},  {3, "R", 30}, {0, "R", 1},
                       {2, "Y", 20}, {1, "Z", 10}, {0, "A", 4}};
    std::vector<ExrRequest> requests;
    for (Wanted& w : wanted) requests.push_back({w.part, w.channel, w.plane.view(), -1});
    const ExrFile file = ExrFile::open(path);
    file.read(requests);
    for (const Wanted& w : wanted) {
      const Rect data = parts[static_cast<std::size_t>(w.part)].data;
      for (int y = kWindow.y0; y < kWindow.y1; ++y) {
        for (int x = kWindow.x0; x < kWindow.x1; ++x) {
          const bool inside = data.contains({x, y, x + 1, y + 1});
          ASSERT_EQ(w.plane.view().at(x, y), inside ? level_at(w.level, x, y) : -1)
              << w.part << w.channel << " at " << x << ", " << y;
        }
      }
    }
  }
  set_file_threads(0);
}

/// OpenEXR keeps the buffers of each part that it has read.
TEST(MultiPart, ChunksOfAllPartsStayWithinTheLimitsTogether) {
  std::vector<WrittenPart> parts;
  for (const char* name : {"a", "b", "c"}) parts.push_back(part_of(name, {0, 0, 64, 16}, {"Y"}));
  const std::filesystem::path path = test::own_folder() / "parts.exr";
  write_parts(path, {0, 0, 64, 16}, parts);
  Limits limits;
  limits.max_memory = 50000;  // a part needs 5 chunks of 4096 bytes
  Plane planes[3] = {Plane(Rect{0, 0, 64, 16}), Plane(Rect{0, 0, 64, 16}),
                     Plane(Rect{0, 0, 64, 16})};
  const auto request = [&](int part) { return ExrRequest{part, "Y", planes[part].view()}; };
  const std::string refused = path.string() +
                              ": the chunks of 3 parts need more memory than the limit of 50000 "
                              "bytes";
  const std::array all = {request(0), request(1), request(2)};
  EXPECT_EQ(error_of([&] { ExrFile::open(path, limits).read(all); }), refused);
  const ExrFile file = ExrFile::open(path, limits);
  for (const int part : {0, 2, 0}) file.read(std::array{request(part)});
  EXPECT_EQ(planes[2].view().at(5, 7), level_at(1, 5, 7));
  EXPECT_EQ(error_of([&] { file.read(std::array{request(1)}); }), refused);
  EXPECT_NO_THROW(file.read(std::array{request(2)}));
}

TEST(MultiPart, ListsTheViewsOfAFileOfOnePart) {
  const std::filesystem::path path = test::own_folder() / "stereo.exr";
  WrittenPart part = part_of("", kDisplay, {"R", "right.R"});
  part.multi_view = {"left", "right"};
  write_parts(path, kDisplay, {part});
  EXPECT_THAT(ExrFile::open(path).parts()[0].views, ElementsAre("left", "right"));
  part.multi_view.clear();
  write_parts(path, kDisplay, {part});
  EXPECT_THAT(ExrFile::open(path).parts()[0].views, IsEmpty());
}

TEST(MultiPart, AListOfViewsThatEndsTooEarlyIsRefused) {
  const std::filesystem::path path = test::own_folder() / "stereo.exr";
  WrittenPart part = part_of("", kDisplay, {"R"});
  part.multi_view = {"left", "right"};
  write_parts(path, kDisplay, {part});
  std::vector<char> bytes = exr_test::bytes_of(path);
  const std::string left = "left";
  const auto at = std::search(bytes.begin(), bytes.end(), left.begin(), left.end());
  ASSERT_NE(at, bytes.end());
  *(at - 4) = 100;  // the length before it
  exr_test::write_bytes(path, bytes);
  EXPECT_THAT(error_of([&] { ExrFile::open(path); }),
              HasSubstr("damaged header (attribute 'multiView' is too short)"));
}

}  // namespace
}  // namespace limpid

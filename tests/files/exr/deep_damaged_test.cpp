#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "limpid/files/exr/deep.h"

#include "files/exr/deep_files.h"

namespace limpid {
namespace {

using exr_test::bytes_of;
using exr_test::DeepPicture;
using exr_test::failure_of;
using exr_test::temporary;
using exr_test::write_bytes;
using exr_test::write_deep_picture;
using ::testing::HasSubstr;
using ::testing::StartsWith;

DeepPicture picture_of(Imf::Compression compression, int tile, bool second_part) {
  DeepPicture picture = exr_test::rgbaz();
  picture.data = {-1, 2, 20, 12};
  picture.channels["ZBack"] = Imf::HALF;
  for (int y = 2; y < 12; ++y) {
    for (int x = -1; x < 20; ++x) {
      for (int s = 0; s < (x + y + 3) % 3; ++s) {
        const auto z = static_cast<float>(s + y);
        picture.samples[{x, y}].push_back({{"Z", z},
                                           {"ZBack", z + 1},
                                           {"R", 0.5f},
                                           {"G", 0.25f},
                                           {"B", 0.125f * z},
                                           {"A", 0.5f}});
      }
    }
  }
  picture.compression = compression;
  picture.tile_width = picture.tile_height = tile;
  picture.second_part = second_part;
  return picture;
}

std::vector<DeepPicture> pictures() {
  return {picture_of(Imf::ZIPS_COMPRESSION, 0, false), picture_of(Imf::NO_COMPRESSION, 0, true),
          picture_of(Imf::RLE_COMPRESSION, 8, false), picture_of(Imf::ZIPS_COMPRESSION, 8, true)};
}

std::vector<char> written(const DeepPicture& picture) {
  const std::string path = temporary("good.exr");
  write_deep_picture(path, picture);
  return bytes_of(path);
}

TEST(DeepDamaged, TruncatedFilesAreRefusedAtEveryLength) {
  const std::string path = temporary("cut.exr");
  for (const DeepPicture& picture : pictures()) {
    const std::vector<char> whole = written(picture);
    for (std::size_t size = 0; size < whole.size(); size += 29) {
      write_bytes(path, {whole.begin(), whole.begin() + static_cast<long>(size)});
      EXPECT_THAT(failure_of(path), StartsWith(path + ": ")) << size << " of " << whole.size();
    }
    write_bytes(path, {whole.begin(), whole.end() - 1});
    EXPECT_THAT(failure_of(path), HasSubstr("reaches beyond the end of the file"));
    write_bytes(path, whole);
    EXPECT_EQ(failure_of(path), "");
  }
}

TEST(DeepDamaged, ChangedBytesNeverDoMoreThanFail) {
  const std::string path = temporary("changed.exr");
  std::mt19937 random(11);
  for (const DeepPicture& picture : pictures()) {
    const std::vector<char> whole = written(picture);
    int refused = 0;
    for (int i = 0; i < 150; ++i) {
      std::vector<char> bytes = whole;
      for (int n = 0; n < 3; ++n) bytes[random() % bytes.size()] = static_cast<char>(random());
      write_bytes(path, bytes);
      const std::string error = failure_of(path);  // any other exception or a crash fails the test
      EXPECT_TRUE(error.empty() || error.starts_with(path + ": ")) << error;
      refused += !error.empty();
    }
    EXPECT_GT(refused, 20);
  }
}

/// Where the first chunk lies in a file of one deep scan-line part: behind the table, whose first
/// entry points right behind a table of `lines` entries.
std::size_t first_chunk(const std::vector<char>& bytes, std::size_t lines) {
  for (std::size_t at = 8; at + 8 < bytes.size(); ++at) {
    std::uint64_t place = 0;
    for (std::size_t i = 8; i-- > 0;) {
      place = place << 8 | static_cast<unsigned char>(bytes[at + i]);
    }
    if (place == at + 8 * lines) return place;
  }
  return 0;
}

void put(std::vector<char>& bytes, std::size_t at, std::uint64_t number, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) bytes[at + i] = static_cast<char>(number >> (8 * i));
}

// A chunk begins with its line (4 bytes) and the sizes of the counts, of the packed and of the
// unpacked samples (8 bytes each).
constexpr std::size_t kCountsSize = 4, kPackedSize = 12, kUnpackedSize = 20, kCounts = 28;

TEST(DeepDamaged, ChunksThatClaimMoreThanTheyHoldAreRefusedBeforeAnythingIsAllocated) {
  const std::string path = temporary("bomb.exr");
  const DeepPicture picture = picture_of(Imf::NO_COMPRESSION, 0, false);
  const std::vector<char> whole = written(picture);
  const std::size_t chunk = first_chunk(whole, 10);
  ASSERT_GT(chunk, 0u);
  const auto failure = [&](std::size_t field, std::uint64_t number) {
    std::vector<char> bytes = whole;
    put(bytes, chunk + field, number, 8);
    write_bytes(path, bytes);
    return failure_of(path);
  };
  for (std::uint64_t bomb : {std::uint64_t{22} << 26, std::uint64_t{22} << 40,
                             std::numeric_limits<std::uint64_t>::max()}) {
    EXPECT_EQ(failure(kUnpackedSize, bomb),
              path + ": truncated or damaged (line 2 cannot hold the samples it claims)");
    EXPECT_EQ(failure(kPackedSize, bomb),
              path + ": truncated or damaged (line 2 reaches beyond the end of the file)");
    EXPECT_EQ(failure(kCountsSize, bomb),
              path + ": truncated or damaged (line 2 reaches beyond the end of the file)");
  }
  EXPECT_THAT(failure(0, 77), HasSubstr("line 2 is stored in another chunk's place"));
}

TEST(DeepDamaged, CountsThatDoNotFitTheStoredSamplesAreRefused) {
  const std::string path = temporary("counts.exr");
  const std::vector<char> whole = written(picture_of(Imf::NO_COMPRESSION, 0, false));
  const std::size_t chunk = first_chunk(whole, 10);
  ASSERT_GT(chunk, 0u);
  const std::size_t last = chunk + kCounts + 4 * 20;  // counts add up along the line
  for (std::uint64_t count : {0u, 1u, 0x7fffffffu, 0xffffffffu}) {
    std::vector<char> bytes = whole;
    put(bytes, last, count, 4);
    write_bytes(path, bytes);
    EXPECT_THAT(failure_of(path), StartsWith(path + ": truncated or damaged (")) << count;
  }
  // Fewer samples than are stored, in ascending order, so nothing but the sum is wrong.
  std::vector<char> bytes = whole;
  for (std::size_t i = 0; i < 21; ++i) put(bytes, chunk + kCounts + 4 * i, 1, 4);
  write_bytes(path, bytes);
  EXPECT_THAT(failure_of(path), HasSubstr("deep samples where"));
}

TEST(DeepDamaged, MissingLinesAreErrors) {
  const std::string path = temporary("hole.exr");
  const std::vector<char> whole = written(picture_of(Imf::NO_COMPRESSION, 0, false));
  const std::size_t table = first_chunk(whole, 10) - 8 * 10;
  std::vector<char> bytes = whole;
  put(bytes, table + 8 * 3, 0, 8);
  write_bytes(path, bytes);
  EXPECT_EQ(failure_of(path), path + ": truncated or damaged (line 5 is missing)");
}

TEST(DeepDamaged, LimitsAreCheckedBeforeTheSamples) {
  const std::string path = temporary("a.exr");
  const View<const float> surface{nullptr, 1, 0, {0, 0, 20, 12}};
  for (int tile : {0, 8}) {
    const DeepPicture picture = picture_of(Imf::ZIPS_COMPRESSION, tile, false);
    std::int64_t samples = 0;
    for (const auto& [pixel, all] : picture.samples) samples += std::ssize(all);
    write_deep_picture(path, picture);
    const auto error = [&](const Limits& limits) {
      return exr_test::error_of([&] { read_deep_layers(ExrFile::open(path, limits), 0, surface); });
    };
    Limits limits;
    limits.max_samples = samples;
    EXPECT_EQ(error(limits), "no error was thrown");
    limits.max_samples = samples - 1;
    EXPECT_EQ(error(limits), path + ": more than " + std::to_string(samples - 1) +
                                 " deep samples in one part, the limit");
    limits = {};
    limits.max_memory = 20 * 12 * 9 * 4;
    EXPECT_THAT(error(limits), HasSubstr(tile == 0 ? "in one piece need more memory" : "no error"));
    limits.max_memory -= 1;
    EXPECT_THAT(error(limits), HasSubstr("its deep layers need more memory than the limit"));
  }
}

}  // namespace
}  // namespace limpid

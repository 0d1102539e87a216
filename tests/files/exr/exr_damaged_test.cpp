#include <algorithm>
#include <random>

#include <gmock/gmock.h>

#include "files/exr/exr_files.h"
#include "paths.h"

namespace limpid {
namespace {

using exr_test::failure_of;
using exr_test::Storage;
using exr_test::temporary;
using exr_test::write_file;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using namespace std::string_literals;

TEST(ExrDamaged, PublicDamagedFilesAreRefusedInOneSentence) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LIMPID_TEST_DATA "/damaged")) {
    const std::string error = failure_of(entry.path());
    EXPECT_THAT(error, StartsWith(entry.path().string() + ": "));
    EXPECT_EQ(std::count_if(error.begin(), error.end(), [](char c) { return c >= 0 && c < 32; }), 0)
        << error;
    ++files;
  }
  EXPECT_EQ(files, 29);
}

std::vector<Storage> storages() {
  return {{"none", Imf::NO_COMPRESSION},
          {"zip"},
          {"piz", Imf::PIZ_COMPRESSION},
          {"decreasing", Imf::ZIP_COMPRESSION, true},
          {"tiles", Imf::PIZ_COMPRESSION, false, 32, 32},
          {"second_part", Imf::ZIP_COMPRESSION, false, 0, 0, false, 1}};
}

/// Good files, in memory.
std::vector<std::vector<char>> good_files() {
  std::vector<std::vector<char>> files;
  const std::string path = temporary("good.exr");
  for (const Storage& storage : storages()) {
    write_file(path, storage);
    files.push_back(exr_test::bytes_of(path));
  }
  exr_test::write_luminance_chroma(path, false);
  files.push_back(exr_test::bytes_of(path));
  return files;
}

TEST(ExrDamaged, TruncatedFilesAreRefusedAtEveryLength) {
  const std::string path = temporary("cut.exr");
  for (const std::vector<char>& whole : good_files()) {
    const std::size_t step = whole.size() / 97;
    for (std::size_t size = 0; size < whole.size(); size += size < 1200 ? 23 : step) {
      exr_test::write_bytes(path, {whole.begin(), whole.begin() + static_cast<long>(size)});
      EXPECT_THAT(failure_of(path), StartsWith(path + ": ")) << size << " of " << whole.size();
    }
    exr_test::write_bytes(path, {whole.begin(), whole.end() - 1});
    EXPECT_THAT(failure_of(path), HasSubstr("truncated or damaged")) << whole.size();
    exr_test::write_bytes(path, whole);
    EXPECT_EQ(failure_of(path), "");
  }
}

/// A render that was stopped leaves zeros in the table of chunks, and may leave a hole in the file.
TEST(ExrDamaged, MissingScanLinesAndTilesAreErrors) {
  const std::string path = temporary("hole.exr");
  for (const Storage& storage : storages()) {
    if (storage.part > 0) continue;
    write_file(path, storage);
    std::vector<char> bytes = exr_test::bytes_of(path);
    // The table begins behind the empty name that ends the header, with the first chunk's place
    // (or, for decreasing lines, the last chunk's): the first 8 bytes that point into the file
    // right behind a table of that length.
    const int chunks = storage.name == "none"    ? 144
                       : storage.name == "tiles" ? 15
                       : storage.name == "piz"   ? 5
                                                 : 9;
    std::size_t table = 0;
    for (std::size_t at = 8; at + 8 < bytes.size() && table == 0; ++at) {
      const std::size_t first =
          storage.decreasing ? at + 8 * static_cast<std::size_t>(chunks - 1) : at;
      std::uint64_t place = 0;
      for (std::size_t i = 8; i-- > 0 && first + i < bytes.size();) {
        place = place << 8 | static_cast<unsigned char>(bytes[first + i]);
      }
      if (place == at + 8 * static_cast<std::size_t>(chunks)) table = at;
    }
    ASSERT_GT(table, 0u) << storage.name;
    std::fill_n(bytes.begin() + static_cast<long>(table) + 16, 16, char{0});
    exr_test::write_bytes(path, bytes);
    const std::string failure = failure_of(path);
    EXPECT_THAT(failure, HasSubstr("is missing")) << storage.name;
    set_file_threads(3);  // they find the upper one of the two, too
    EXPECT_EQ(failure_of(path), failure) << storage.name;
    set_file_threads(0);
  }
}

TEST(ExrDamaged, ChangedBytesNeverDoMoreThanFail) {
  const std::string path = temporary("changed.exr");
  std::mt19937 random(7);
  for (const std::vector<char>& whole : good_files()) {
    for (int i = 0; i < 60; ++i) {
      std::vector<char> bytes = whole;
      const std::size_t reach =
          i % 2 == 0 ? std::min<std::size_t>(bytes.size(), 600) : bytes.size();
      for (int n = 0; n < 3; ++n) bytes[random() % reach] = static_cast<char>(random());
      exr_test::write_bytes(path, bytes);
      const std::string error = failure_of(path);  // any other exception or a crash fails the test
      EXPECT_TRUE(error.empty() || error.starts_with(path + ": ")) << error;
    }
  }
}

TEST(ExrDamaged, AHeaderThatPromisesTooMuchIsRefusedUnread) {
  const std::string path = temporary("bomb.exr");
  write_file(path, {"zip"});
  std::vector<char> bytes = exr_test::bytes_of(path);
  const std::string name("dataWindow\0box2i", 16);
  const auto at = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
  ASSERT_NE(at, bytes.end());
  const std::size_t box = static_cast<std::size_t>(at - bytes.begin()) + 16 + 1 + 4;
  const std::int32_t window[] = {0, 0, 16383, 16383};
  std::copy_n(reinterpret_cast<const char*>(window), sizeof window,
              bytes.begin() + static_cast<long>(box));
  exr_test::write_bytes(path, bytes);
  EXPECT_THAT(failure_of(path), HasSubstr("16384x16384 pixels of 3 channels cannot be in"));
}

/// A good file with one more attribute in front of the others.
std::vector<char> with_attribute(const std::string& name_and_type, const std::string& value) {
  const std::string path = temporary("plain.exr");
  write_file(path, {"zip"});
  std::vector<char> bytes = exr_test::bytes_of(path);
  std::string attribute = name_and_type;
  for (std::size_t i = 0; i < 4; ++i) attribute += static_cast<char>(value.size() >> (8 * i) & 255);
  attribute += value;
  bytes.insert(bytes.begin() + 8, attribute.begin(), attribute.end());
  return bytes;
}

/// OpenEXR takes as many bytes as the type has, whatever the file says.
TEST(ExrDamaged, AttributesHaveTheSizeOfTheirType) {
  const std::string path = temporary("sizes.exr");
  const auto failure_with = [&](const std::string& type, const std::string& value) {
    exr_test::write_bytes(path, with_attribute("a\0"s + type + "\0"s, value));
    return failure_of(path);  // of the moved chunks, where the header is good
  };
  struct Sized {
    const char* type;
    std::size_t bytes;
  };
  for (const auto& [type, bytes] :
       {Sized{"int", 4}, Sized{"box2i", 16}, Sized{"m44f", 64}, Sized{"floatvector", 8},
        Sized{"v3d", 24}, Sized{"chlist", 1}}) {
    EXPECT_THAT(failure_with(type, std::string(bytes, '\0')), testing::Not(HasSubstr("of type")));
    for (const std::size_t wrong : {bytes - 1, bytes + 1}) {
      EXPECT_THAT(failure_with(type, std::string(wrong, '\0')),
                  HasSubstr(" has " + std::to_string(wrong) + " bytes"));
    }
  }
  const std::string channel = "R\0"s + std::string(16, '\0');
  for (const std::string& list : {channel, "R"s, channel + channel, channel + "\0\0"s}) {
    EXPECT_THAT(failure_with("chlist", list), HasSubstr("has " + std::to_string(list.size())));
  }
  EXPECT_THAT(failure_with("idmanifest", std::string(12, '\0')), HasSubstr("is not supported"));
  EXPECT_THAT(failure_with("ours", std::string(13, '\0')), testing::Not(HasSubstr("of type")));
}

TEST(ExrDamaged, AnAttributeIsThereOnce) {
  const std::string path = temporary("twice.exr");
  exr_test::write_bytes(path, with_attribute("pixelAspectRatio\0float\0"s, "\0\0\x80\x3f"s));
  EXPECT_THAT(failure_of(path), HasSubstr("two attributes 'pixelAspectRatio'"));
}

}  // namespace
}  // namespace limpid

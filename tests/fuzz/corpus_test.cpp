#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>

#include "fuzz/harness.h"
#include "paths.h"

/// Every seed of a harness, and every file that once broke a harness, is refused or read.

namespace limpid::fuzz {
namespace {

namespace fs = std::filesystem;

struct Parser {
  const char* name;
  void (*harness)(Bytes);
};

void PrintTo(const Parser& parser, std::ostream* out) { *out << parser.name; }

class Corpus : public testing::TestWithParam<Parser> {};

TEST_P(Corpus, DoesNoHarm) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(LIMPID_FUZZ_CORPUS) / GetParam().name)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  EXPECT_GE(files.size(), 3u);
  for (const fs::path& path : files) {
    std::ifstream in(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    EXPECT_NO_THROW(GetParam().harness({data, bytes.size()})) << path;
  }
}

constexpr Parser kParsers[] = {
    {"exr", exr}, {"scene", scene}, {"look", look}, {"gltf", gltf}, {"cli", cli}};

INSTANTIATE_TEST_SUITE_P(Of, Corpus, testing::ValuesIn(kParsers),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Harness, TakesErrorsAndNothingElse) {
  EXPECT_TRUE(accepts([] {}));
  EXPECT_FALSE(accepts([] { throw Error("x = 1: expected 2"); }));
  EXPECT_THROW(accepts([] { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_THROW(accepts([] { throw Error(""); }), std::logic_error);
  EXPECT_THROW(expect(false, "a promise"), std::logic_error);
}

}  // namespace
}  // namespace limpid::fuzz

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/files/text/look_file.h"
#include "limpid/files/text/scene_file.h"

#include "files/exr/written.h"

/// Texts that would take the parser, or whoever reads its sentences, too far.

namespace limpid {
namespace {

using test::error_of;
using testing::HasSubstr;

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

std::string error_of_scene(const std::string& text) {
  return error_of([&] { scene_from_toml(text, "s.toml"); });
}

TEST(TomlLimits, DottedKeysOfAnyLengthAreRefused) {
  for (const int dots : {17, 100, 30000}) {
    const std::string key = "a" + repeated(".a", dots);
    for (const std::string& text : {key + " = 1", "[" + key + "]", "x = {" + key + " = 1}",
                                    "[[" + key + "]]", repeated("\"a\" . ", dots) + "a = 1"}) {
      EXPECT_THAT(error_of_scene("# first\n" + text),
                  HasSubstr("s.toml:2: a key of more than 16 dots"));
    }
  }
}

TEST(TomlLimits, BracketsNestSixteenDeep) {
  const auto nested = [](int depth) { return repeated("[", depth) + repeated("]", depth); };
  EXPECT_THAT(error_of_scene("x = " + nested(16)), HasSubstr("unknown table 'x'"));
  EXPECT_THAT(error_of_scene("x = " + nested(17)),
              HasSubstr("s.toml:1: brackets nested more than 16 deep"));
  EXPECT_THAT(error_of_scene("x = " + repeated("{a = ", 40000)), HasSubstr("brackets nested"));
  EXPECT_THAT(error_of_scene(repeated("[x]\n", 40)), HasSubstr("s.toml:2:"));  // x again
}

TEST(TomlLimits, DotsAndBracketsInTextsCommentsAndListsDoNotCount) {
  const std::string noise = repeated(".[{", 40);
  const std::string numbers = "1.5" + repeated(", 1.5", 40);
  for (const std::string& value :
       {"\"" + noise + "\"", "'" + noise + "'", "\"\\\"" + noise + "\"",
        R"("""")" + noise + "\n" + noise + R"(""""")", "'''" + noise + "\n" + noise + "''''",
        "\"\" # " + noise, "[" + numbers + "]"}) {
    const std::string sentence = error_of_scene("[sun]\ndirection = " + value + "\nx.y = 1");
    EXPECT_THAT(sentence, HasSubstr("unknown key 'sun.x'")) << value;
  }
}

TEST(TomlLimits, NoNestingHidesBehindAString) {
  const std::string key = "a" + repeated(".a", 40) + " = 1\n";
  for (const std::string before :
       {R"(x = "")", "x = ''", R"(x = "\\")", R"(x = '\')", R"(x = """a""""")", "x = ''''a'''''",
        "# '''", "x = \"not closed"}) {
    EXPECT_THAT(error_of_scene(before + "\n" + key), HasSubstr("a key of more than 16 dots"))
        << before;
  }
}

TEST(TomlLimits, SentencesStayShort) {
  const std::string letters(100000, 'a');
  EXPECT_EQ(error_of_scene(letters + " = 1"),
            "s.toml:1:1: a key of 100000 letters: expected at most 64");
  std::string path = "[" + std::string(60, 'a');
  for (int i = 0; i < 9; ++i) path += "." + std::string(60, 'b');
  EXPECT_THAT(error_of_scene(path + "]"),
              testing::HasSubstr("letters in all: expected at most 512"));
  EXPECT_LT(error_of_scene("[sun]\ndirection = \"" + letters + "\"").size(), 200u);
  EXPECT_LT(error_of([&] { look_from_toml("water = \"" + letters + "\"", "look"); }).size(), 200u);
}

TEST(TomlLimits, TextsInPicturesAreLimitedAsFilesAre) {
  EXPECT_THAT(error_of_scene(std::string(262145, ' ')), HasSubstr("larger than 256 KiB"));
  EXPECT_EQ(error_of_scene(std::string(262144, ' ')), "");
}

}  // namespace
}  // namespace limpid

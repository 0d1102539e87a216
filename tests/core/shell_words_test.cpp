#include "core/shell_words.h"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace limpid::test {
namespace {

/// The words that a shell makes of the line.
std::string printed_by_shell(const std::string& line) {
  FILE* const pipe = ::popen(("printf '%s|' " + line).c_str(), "r");
  std::string text;
  std::array<char, 256> part{};
  while (const std::size_t got = std::fread(part.data(), 1, part.size(), pipe)) {
    text.append(part.data(), got);
  }
  ::pclose(pipe);
  return text;
}

TEST(ShellWordsTest, AreTakenApartAsTheyWere) {
  const std::vector<std::string> words = {"plain", "a b",      "it's", "$(id) `id` \"x\" \\ * ~",
                                          "",      "a=[1, 2]", "-o",   "\xc3\xa4",
                                          "#",     "~",        "a\nb"};
  std::string expected;
  for (const std::string& word : words) expected += word + "|";
  EXPECT_EQ(printed_by_shell(shell_line(words)), expected);
}

}  // namespace
}  // namespace limpid::test

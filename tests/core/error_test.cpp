#include "limpid/core/error.h"

#include <gtest/gtest.h>

namespace limpid {
namespace {

TEST(Error, KeepsSentenceAndFault) {
  const Error plain("a = 1: expected 2"), retry("disk full", Fault::kRetry);
  EXPECT_STREQ(plain.what(), "a = 1: expected 2");
  EXPECT_EQ(plain.fault(), Fault::kJob);
  EXPECT_EQ(retry.fault(), Fault::kRetry);
}

TEST(Error, MemoryEndsItsSentenceInTheSameWords) {
  for (const Error& error : {no_memory(), no_memory("plate.exr")}) {
    EXPECT_EQ(error.fault(), Fault::kMemory);
    EXPECT_TRUE(std::string_view(error.what()).ends_with(kNeedsMemory)) << error.what();
  }
  EXPECT_STREQ(no_memory("plate.exr").what(), "plate.exr: needs more memory than there is");
}

TEST(NearestName, FindsSlipsOfTheHandOnly) {
  const std::vector<std::string> known = {"strength", "density", "offset", "rejection"};
  EXPECT_EQ(nearest_name("strenght", known), "strength");
  EXPECT_EQ(nearest_name("densty", known), "density");
  EXPECT_EQ(nearest_name("dnesiyt", known), "density");  // neighbours swapped, twice
  EXPECT_EQ(nearest_name("rejections", known), "rejection");
  EXPECT_EQ(nearest_name("offset", known), "offset");
  EXPECT_EQ(nearest_name("colour", known), "");
  EXPECT_EQ(nearest_name("", known), "");
  EXPECT_EQ(nearest_name("offset", {}), "");
  EXPECT_EQ(nearest_name(std::string(50'000'000, 'x'), known), "");  // returns at once
}

TEST(NearestName, AsASentence) {
  EXPECT_EQ(did_you_mean("densty", {"density"}), "; did you mean 'density'?");
  EXPECT_EQ(did_you_mean("zzz", {"density"}), "");
}

TEST(Join, WordsWithCommas) {
  EXPECT_EQ(join({}), "");
  EXPECT_EQ(join({"a"}), "a");
  EXPECT_EQ(join({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(join({"a", "b"}, " or "), "a or b");
}

}  // namespace
}  // namespace limpid

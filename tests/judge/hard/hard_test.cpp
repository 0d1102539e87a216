#include "judge/hard/hard.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "paths.h"

namespace limpid {
namespace {

class Hard : public testing::TestWithParam<std::string> {};

TEST_P(Hard, IsWithinItsBound) {
  static const HardSuite suite(LIMPID_DATA);
  const HardRow row = suite.measure(GetParam());
  EXPECT_TRUE(row.passed()) << to_text(std::span(&row, 1)) << row.reason;
  EXPECT_TRUE(std::isfinite(row.bound) && row.bound >= 0) << "a bound that cannot be broken";
  RecordProperty("margin", std::to_string(row.margin()));
}

/// As words, because test names hold only letters and digits.
std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); },
      '_');
  return name;
}

TEST(HardSuite, NamesAreUniqueAndUnknownOnesAreRefused) {
  const std::vector<std::string> names = HardSuite::names();
  EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size());
  EXPECT_THROW(HardSuite(LIMPID_DATA).measure("depth: 25 bit"), Error);
  EXPECT_THROW(HardSuite("/nowhere"), Error);
}

HardRow row_of(const std::string& name, double bound, double measured) {
  return {"pond", name, "frogs", "none were there", bound, measured, 7, "pixel 3 4"};
}

TEST(HardRow, PassesWithinItsBoundAndNowhereElse) {
  EXPECT_TRUE(row_of("a", 2, 1.5).passed());
  EXPECT_EQ(row_of("a", 2, 1.5).margin(), 0.25);
  EXPECT_TRUE(row_of("a", 2, 2).passed());
  EXPECT_FALSE(row_of("a", 2, 2.5).passed());
  EXPECT_EQ(row_of("a", 2, 2.5).margin(), -0.25);
  EXPECT_FALSE(row_of("a", 2, NAN).passed());
  EXPECT_TRUE(row_of("a", 0, 0).passed());
  EXPECT_EQ(row_of("a", 0, 0).margin(), 1);
  EXPECT_EQ(row_of("a", 0, 1).margin(), -INFINITY);
  HardRow nothing = row_of("a", 0, 0);
  nothing.values = 0;
  EXPECT_FALSE(nothing.passed()) << "nothing was judged";
}

TEST(HardRow, TextNamesWhatFailed) {
  const HardRow rows[] = {row_of("heron", 1, 0.5), row_of("newt", 1, 3)};
  const std::string text = to_text(rows);
  EXPECT_NE(text.find("pond: heron"), text.npos);
  EXPECT_EQ(text.find("FAILED"), text.rfind("FAILED: pixel 3 4\n"));
  EXPECT_NE(text.find("1 of 2 hard cases are within their bounds"), text.npos);
}

INSTANTIATE_TEST_SUITE_P(Case, Hard, testing::ValuesIn(HardSuite::names()), test_name);

}  // namespace
}  // namespace limpid
